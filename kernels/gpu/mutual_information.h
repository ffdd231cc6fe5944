// Records mutual_information (kernels/mutual_information.h, information_push.h) on the cells of
// several views.
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
  // One list of cells a view. Throws LogicError where check_information() does.
  void record(Batch& batch, std::span<const DeviceCells> cells, double cap_px,
              std::span<const ParticleBelief> beliefs, const InformationOptions& options);
  // One value a view, nats, after the batch has run.
  std::vector<double> information() const;

 private:
  struct OfView {
    Buffer<float> shifts, shares;
    std::vector<float> host_shares;
  };

  const Device& device_;
  Kernel rows_kernel_, columns_kernel_;
  Buffer<InformationBelief> beliefs_;
  std::vector<OfView> views_;
  double log_scale_ = 0;  // of the shares
};

}  // namespace edgescout::gpu
