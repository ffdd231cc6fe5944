// Records mutual_information (kernels/mutual_information.h, information_push.h) on the cells of one
// view.
#pragma once

#include <span>
#include <vector>

#include "kernels/gpu/combination_chamfer.h"
#include "kernels/information_push.h"
#include "kernels/mutual_information.h"

namespace edgescout::gpu {

class MutualInformation {
 public:
  explicit MutualInformation(const Device& device);
  // Throws LogicError where check_information() does.
  void record(Batch& batch, const DeviceCells& cells, double cap_px,
              std::span<const ParticleBelief> beliefs, const InformationOptions& options);
  // After the batch has run, nats.
  double information() const;

 private:
  const Device& device_;
  Kernel rows_kernel_, columns_kernel_;
  Buffer<InformationBelief> beliefs_;
  Buffer<float> shifts_, shares_;
  double log_scale_ = 0;  // of the shares
  std::vector<float> host_shares_;
};

}  // namespace edgescout::gpu
