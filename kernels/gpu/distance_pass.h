// Records distance_pass: seed lists in, capped distances in the tensor's layout out
// (kernels/distance_pass.h).
#pragma once

#include "kernels/gpu/batch.h"
#include "kernels/gpu/dcd_seed.h"
#include "kernels/gpu/tensor.h"

namespace edgescout::gpu {

class DistancePass {
 public:
  explicit DistancePass(const Device& device);
  // `cap` in 1/256 px. The lists must have been made for the tensor's shape.
  void record(Batch& batch, const SeedLists& lists, std::uint32_t cap,
              const DeviceTensor& tensor) const;

 private:
  Kernel plain_, many_;
};

}  // namespace edgescout::gpu
