#include "host/render/measure_depth.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "host/render/camera_effects.h"
#include "host/render/depth_borders.h"
#include "host/render/depth_holes.h"
#include "host/render/optics.h"
#include "host/render/smooth_noise.h"
#include "kernels/thread_pool.h"

namespace edgescout {
namespace {

// What the pixels' centres see through the lens: of the finer image, the nearest sample.
std::vector<SeenSurface> surfaces_through_lens(const ViewRaster& view, const Camera& camera,
                                               std::size_t number, ThreadPool& pool) {
  const int n = view.scene.options.supersampling;
  const RadialDistortion lens(camera, lens_residue_px(view.scene.options, number));
  std::vector<SeenSurface> surfaces(static_cast<std::size_t>(camera.width) * camera.height);
  const auto nearest = [n](double px, int fine) {
    return std::clamp(static_cast<int>(std::lround(n * px + 0.5 * (n - 1))), 0, fine - 1);
  };
  for_each_in_chunks(pool, surfaces.size(), 4096, [&](std::size_t i) {
    const int x = static_cast<int>(i % camera.width), y = static_cast<int>(i / camera.width);
    const Eigen::Vector2d ideal = lens.before(x, y);
    surfaces[i] =
        seen_at(view, nearest(ideal.x(), view.fine.width), nearest(ideal.y(), view.fine.height));
  });
  return surfaces;
}

DepthImage true_depth(const SensedView& sensed) {
  DepthImage depth{sensed.grey.width, sensed.grey.height, {}};
  for (const SeenSurface& seen : sensed.surfaces)
    depth.z_m.push_back(seen.triangle == HORIZON ? DEPTH_MISSING
                                                 : static_cast<float>(seen.depth_m));
  return depth;
}

void add_noise(DepthImage& depth, const SensedView& sensed) {
  const double sigma = sensed.sensor().noise_m;
  if (sigma <= 0) return;
  const cv::Mat noise = smooth_noise({depth.width, depth.height}, sensed.sensor().noise_blur_px,
                                     sensed.stream("depth noise"));
  for (std::size_t i = 0; i < depth.z_m.size(); ++i)
    depth.z_m[i] += static_cast<float>(sigma * depth.z_m[i] * depth.z_m[i] *
                                       noise.at<float>(static_cast<int>(i)));
}

// Rounds to whole steps of disparity.
void take_steps(DepthImage& depth, double step_m) {
  if (step_m <= 0) return;
  for (float& z_m : depth.z_m)
    if (z_m > 0) {
      const double steps = std::max(1.0, std::round(1 / (step_m * z_m)));
      z_m = static_cast<float>(1 / (step_m * steps));
    }
}

void add_bias(DepthImage& depth, double bias_m) {
  for (float& z_m : depth.z_m)
    if (z_m != DEPTH_MISSING) z_m += static_cast<float>(bias_m);
}

// The image of the same points after they were turned about the camera's centre. What moves in from
// outside the image is missing.
DepthImage turned(const DepthImage& depth, const Camera& camera,
                  const Eigen::Matrix3d& turned_from_true) {
  DepthImage out{depth.width, depth.height, std::vector<float>(depth.z_m.size(), DEPTH_MISSING)};
  for (int y = 0; y < depth.height; ++y)
    for (int x = 0; x < depth.width; ++x) {
      const Eigen::Vector3d ray =
          turned_from_true.transpose() * ray_through(camera, Eigen::Vector2d(x, y));
      if (ray.z() <= 0) continue;
      const Eigen::Vector2d from = project(camera, ray).array().round();
      if (!(from.x() >= 0 && from.y() >= 0 && from.x() < depth.width && from.y() < depth.height))
        continue;
      const float z_m = depth.at(static_cast<int>(from.x()), static_cast<int>(from.y()));
      out.z_m[static_cast<std::size_t>(y) * depth.width + x] =
          static_cast<float>(z_m * (turned_from_true.row(2) * ray_through(camera, from)).value());
    }
  return out;
}

// The error is that of the mounting: the same in all views of a scene.
void miscalibrate(DepthImage& depth, const SensedView& sensed) {
  const double angle_rad = sensed.sensor().rotation_deg * std::numbers::pi / 180;
  if (angle_rad == 0) return;
  Random random = Random(sensed.view.scene.options.seed).split("depth rotation");
  depth = turned(depth, sensed.scene_view.camera,
                 so3_exp(angle_rad * random.direction()).toRotationMatrix());
}

}  // namespace

DepthImage measure_depth(const ViewRaster& view, const SceneView& scene_view,
                         const SceneShading& shading, const Image& grey, std::size_t number,
                         ThreadPool& pool) {
  const SensedView sensed{view,    scene_view,
                          shading, grey,
                          number,  surfaces_through_lens(view, scene_view.camera, number, pool)};
  DepthImage depth = true_depth(sensed);
  smear_borders(depth, sensed);
  add_noise(depth, sensed);
  take_steps(depth, sensed.sensor().step_m);
  add_bias(depth, sensed.sensor().bias_m);
  drop_unmeasured(depth, sensed, pool);
  miscalibrate(depth, sensed);
  return depth;
}

}  // namespace edgescout
