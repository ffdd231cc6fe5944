#include <cmath>

#include "kernels/error.h"
#include "kernels/pose_depth.h"
#include "kernels/pose_problems.h"

namespace edgescout {

void check_depth_view(const DepthView& view) {
  check(view.width > 0 && view.height > 0, "pose_depth: a depth image without pixels");
  check(view.z_m.size() == std::size_t(view.width) * std::size_t(view.height),
        "pose_depth: a depth image of another size than its values");
}

void check_pose_depth(std::size_t views, std::size_t points, std::span<const PoseProblem> problems,
                      const PoseDepthOptions& options, std::size_t results) {
  check(results == problems.size(), "pose_depth: as many results as problems");
  for (const float v : {options.noise_floor_m, options.noise_per_m, options.surface_m,
                        options.band_m, options.loss_scale})
    check(std::isfinite(v) && v >= 0, "pose_depth: options are finite and not negative");
  check(options.noise_floor_m >= DEPTH_MIN_NOISE_M, "pose_depth: noise_floor_m is at least 1e-6");
  check(options.loss_scale > 0, "pose_depth: loss_scale is positive");
  check_pose_problems(problems, points, views);
}

}  // namespace edgescout
