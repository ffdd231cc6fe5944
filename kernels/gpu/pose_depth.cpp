#include "kernels/gpu/pose_depth.h"

#include <algorithm>
#include <string>

#include "kernels/error.h"
#include "kernels/pose_depth_push.h"
#include "pose_depth.spv.h"

namespace edgescout::gpu {

static_assert(sizeof(PoseDepth) == sizeof(float) * POSE_DEPTH_SUMS);

Buffer<float> depth_buffer(const Device& device, int width, int height) {
  const std::size_t pixels = std::size_t(width) * std::size_t(height);
  const VkDeviceSize bytes = pixels * sizeof(float),
                     most = std::min(device.max_band_bytes(), device.max_allocation_bytes());
  const auto too_large = [&](const std::string& room) {
    return InputError("depth image", "size",
                      std::to_string(width) + "x" + std::to_string(height) + ": " +
                          std::to_string(bytes) + " bytes",
                      room + " (a smaller image, or --device cpu)");
  };
  if (bytes > most)
    throw too_large("at most " + std::to_string(most) + " bytes on " + device.info().name);
  try {
    return {device, pixels, "depth image"};
  } catch (const OutOfDeviceMemory&) {
    throw too_large("no more than " + device.info().name + " has free");
  }
}

PoseDepths::PoseDepths(const Device& device, std::uint32_t min_groups)
    : kernel_(device, {"pose_depth", pose_depth_spv, 4, sizeof(PoseDepthPush), {}}),
      min_groups_(min_groups > 0 ? min_groups : groups_to_fill(device)),
      device_(device),
      buffers_(device) {}

std::size_t PoseDepths::that_fit(std::span<const PoseProblem> problems) const {
  return poses_that_fit(device_, problems, POSE_DEPTH_SUMS);
}

void PoseDepths::record(Batch& batch, std::span<const DepthImageView> views,
                        const PosePoints& points, std::span<const PoseProblem> problems,
                        const PoseDepthOptions& options) {
  plan_ = plan_poses(problems, points.count(), views.size(), min_groups_);
  buffers_.upload(batch, plan_, points, problems, POSE_DEPTH_SUMS);
  for (const PosePlan::Run& run : plan_.runs) {
    const DepthImageView& view = views[run.view];
    const PoseDepthPush push{pose_camera(view.intrinsics),
                             static_cast<std::uint32_t>(view.width),
                             static_cast<std::uint32_t>(view.height),
                             run.first,
                             plan_.parts,
                             MIN_FACING,
                             BAND_SIGMAS,
                             options.noise_floor_m,
                             options.noise_per_m,
                             options.surface_m,
                             options.band_m,
                             options.loss_scale};
    batch.dispatch(kernel_, {plan_.parts, run.count},
                   {buffers_.points(), buffers_.problems(), buffers_.results(), *view.depth_m},
                   push);
  }
  buffers_.download(batch);
}

void PoseDepths::collect(std::span<PoseDepth> out) const {
  check(out.size() == plan_.order.size(), "pose_depth: as many results as problems");
  double totals[POSE_DEPTH_SUMS];
  for (std::size_t n = 0; n < plan_.order.size(); ++n) {
    buffers_.total(plan_, n, totals);
    PoseDepth& sum = out[plan_.order[n]];
    std::copy(totals, totals + 21, sum.hessian);
    std::copy(totals + 21, totals + 27, sum.gradient);
    sum.cost = float(totals[27]);
    sum.weight_sum = float(totals[28]);
    sum.offset_m = float(totals[29]);
    sum.agreeing = float(totals[30]);
    sum.contradicting = float(totals[31]);
    sum.hidden = float(totals[32]);
    sum.missing = float(totals[33]);
  }
}

}  // namespace edgescout::gpu
