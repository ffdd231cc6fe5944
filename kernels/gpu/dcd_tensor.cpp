#include "kernels/gpu/dcd_tensor.h"

#include <cmath>

namespace edgescout::gpu {

void DcdTensorBuilder::record(Batch& batch, std::span<const EdgePoint> edges,
                              const TensorOptions& options, const DeviceTensor& tensor) {
  options.validate();
  const auto cap =
      static_cast<std::uint32_t>(std::lround(double(DCD_UNITS_PER_PX) * options.cap_px));
  seed_.record(batch, edges, tensor.shape(), lists_);
  distance_.record(batch, lists_, cap, tensor);
  sweep_.record(batch, options, cap, tensor);
}

}  // namespace edgescout::gpu
