// Records dcd_sweep: the recursion over orientation and its smoothing, in place
// (kernels/dcd_sweep.h).
#pragma once

#include <map>

#include "kernels/gpu/batch.h"
#include "kernels/gpu/tensor.h"

namespace edgescout::gpu {

class DcdSweep {
 public:
  explicit DcdSweep(const Device& device) : device_(device) {}
  // `cap` and the tensor's values in 1/256 px.
  void record(Batch& batch, const TensorOptions& options, std::uint32_t cap,
              const DeviceTensor& tensor);

 private:
  const Kernel& kernel_of(std::uint32_t radius);

  const Device& device_;
  std::map<std::uint32_t, Kernel> kernels_;  // by radius of the smoothing
  Buffer<std::uint32_t> weights_;
};

}  // namespace edgescout::gpu
