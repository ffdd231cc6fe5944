#include "kernels/gpu/dcd_sweep.h"

#include <algorithm>

#include "dcd_sweep.spv.h"
#include "kernels/dcd_sweep.h"
#include "kernels/dcd_tensor.h"
#include "kernels/error.h"

namespace edgescout::gpu {

const Kernel& DcdSweep::kernel_of(std::uint32_t radius) {
  check(radius <= DCD_SWEEP_MAX_RADIUS, "dcd_sweep: a wider smoothing than the shader's window");
  const auto found = kernels_.find(radius);
  if (found != kernels_.end()) return found->second;
  const KernelSource source{"dcd_sweep", dcd_sweep_spv, 2, sizeof(DcdSweepPush), {radius}};
  return kernels_.emplace(radius, Kernel(device_, source)).first->second;
}

void DcdSweep::record(Batch& batch, const TensorOptions& options, std::uint32_t cap,
                      const DeviceTensor& tensor) {
  const std::vector<std::uint16_t> narrow =
      smoothing_weights(options.smoothing_variance, options.bins);
  const std::vector<std::uint32_t> weights(narrow.begin(), narrow.end());
  weights_.reserve(device_, DCD_MAX_BINS, "smoothing weights");
  batch.upload<std::uint32_t>(weights_, weights);
  batch.barrier();
  const auto bins = static_cast<std::uint32_t>(options.bins);
  const std::uint32_t step = orientation_step(options);
  const std::uint32_t reach = step == 0 ? bins : std::min(bins, (cap + step - 1) / step);
  const Kernel& kernel = kernel_of(static_cast<std::uint32_t>(weights.size()) - 1);
  for (std::uint32_t band = 0; band < tensor.bands(); ++band) {
    const std::uint32_t tiles =
        static_cast<std::uint32_t>(tensor.shape().tiles_per_row()) * tensor.row_count(band);
    const DcdSweepPush push{tiles, bins, step, cap, reach};
    const std::uint32_t groups = groups_for(std::size_t(tiles) * DCD_SWEEP_LANES, DCD_SWEEP_GROUP);
    batch.dispatch(kernel, spread(groups), {tensor.band(band), weights_}, push);
  }
  batch.barrier();
}

}  // namespace edgescout::gpu
