// Edge points -> DCD tensor on the device: dcd_seed, distance_pass and dcd_sweep in one batch
// (kernels/dcd_tensor.h).
#pragma once

#include <span>

#include "kernels/gpu/dcd_seed.h"
#include "kernels/gpu/dcd_sweep.h"
#include "kernels/gpu/distance_pass.h"

namespace edgescout::gpu {

class DcdTensorBuilder {
 public:
  explicit DcdTensorBuilder(const Device& device)
      : seed_(device), distance_(device), sweep_(device) {}
  // The builder's scratch is in use until the batch has run.
  void record(Batch& batch, std::span<const EdgePoint> edges, const TensorOptions& options,
              const DeviceTensor& tensor);

 private:
  DcdSeed seed_;
  DistancePass distance_;
  DcdSweep sweep_;
  SeedLists lists_;
};

}  // namespace edgescout::gpu
