// Sums of residuals over the points of one pose in all views.
#pragma once

#include <functional>

#include "host/register/image_motion.h"
#include "host/register/lm_state.h"

namespace edgescout {

// Adds one scalar residual with its weight and loss. `motion` is its derivative by the camera's
// tangent.
inline void add_residual(WorldSystem& sum, double residual, double weight, double rho,
                         const Vector6d& motion) {
  sum.hessian += weight * motion * motion.transpose();
  sum.gradient += weight * residual * motion;
  sum.cost += rho;
}

struct Weighted {
  double rho, weight;  // weight = rho'(r) / r
};
inline Weighted huber(double r, double scale) {
  return r <= scale ? Weighted{0.5 * r * r, 1} : Weighted{scale * (r - 0.5 * scale), scale / r};
}

// Calls visit(sum, view, point index, posed point, projection) for every point in front of its
// camera. `sum` is in the camera's tangent.
template <typename Visit>
WorldSystem sum_over_points(std::span<const ObjectView> views,
                            std::span<const std::vector<ModelPoint>> points,
                            const Se3& world_from_object, const Visit& visit) {
  WorldSystem sum;
  for (std::size_t v = 0; v < views.size(); ++v) {
    const Pose pose = to_pose(views[v].camera_from_world * world_from_object);
    WorldSystem in_camera;
    for (std::size_t i = 0; i < points[v].size(); ++i) {
      const PosedPoint<double> posed = pose_point<double>(pose, points[v][i]);
      if (!can_be_seen(posed.point)) continue;
      visit(in_camera, v, i, posed, project_edge(posed, views[v].tensor->intrinsics));
    }
    add_view(sum, in_camera, views[v].camera_from_world);
  }
  return sum;
}

// Levenberg-Marquardt from the state's pose, at most `iterations` steps.
using SystemAt = std::function<WorldSystem(const Se3& world_from_object)>;
void levenberg_marquardt(LmState& state, const SystemAt& system_at, int iterations,
                         double min_step_m, double min_step_rad);

}  // namespace edgescout
