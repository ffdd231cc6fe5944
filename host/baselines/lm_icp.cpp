// LM-ICP: Fitzgibbon, Robust registration of 2D and 3D point sets, BMVC 2001: Levenberg-Marquardt
// with a robust loss on the distance transform, which takes the place of the closest points.
#include <algorithm>
#include <cmath>
#include <memory>

#include "host/baselines/methods.h"
#include "host/baselines/nearest_edge.h"
#include "host/baselines/point_sums.h"
#include "kernels/error.h"

namespace edgescout {

namespace {

// Like the tensor: outside the image the border's value plus the distance to it.
Sample distance_at(const ScalarImage& distance, double x_px, double y_px) {
  Sample s = sample(distance, x_px, y_px);
  const double out_x = x_px - std::clamp(x_px, 0.0, distance.width - 1.0),
               out_y = y_px - std::clamp(y_px, 0.0, distance.height - 1.0);
  const double out = std::hypot(out_x, out_y);
  if (out == 0) return s;
  s.value += out;
  s.by_x += out_x / out;
  s.by_y += out_y / out;
  return s;
}

}  // namespace

WorldSystem distance_system(std::span<const ObjectView> views,
                            std::span<const std::vector<ModelPoint>> points,
                            std::span<const ScalarImage> distances, const Se3& world_from_object,
                            double loss_scale_px) {
  return sum_over_points(views, points, world_from_object,
                         [&](WorldSystem& sum, std::size_t v, std::size_t,
                             const PosedPoint<double>& posed, const ProjectedEdge<double>& at) {
                           const Sample d = distance_at(distances[v], at.u, at.v);
                           const Weighted loss = huber(d.value, loss_scale_px);
                           add_residual(
                               sum, d.value, loss.weight, loss.rho,
                               image_motion(d.by_x, d.by_y, posed, views[v].tensor->intrinsics));
                           sum.residual_sum += d.value;
                           sum.weight_sum += loss.weight;
                           sum.points += 1;
                         });
}

PoseSolver prepare_lm_icp(std::span<const ObjectView> views, const BaselineOptions& options) {
  const auto distances = std::make_shared<std::vector<ScalarImage>>();
  for (const ObjectView& view : views) {
    check(view.edges != nullptr, "lm-icp: a view without edge points");
    const std::span<const EdgePoint> edges = view.edges->points();
    distances->push_back(distance_image(nearest_edges(edges, view.camera.width, view.camera.height),
                                        edges, view.tensor->options.cap_px));
  }
  return [views, options, distances](const Se3& start,
                                     std::span<const std::vector<ModelPoint>> points) {
    LmState state;
    state.pose = start;
    levenberg_marquardt(
        state,
        [&](const Se3& pose) {
          return distance_system(views, points, *distances, pose, options.loss_scale_px);
        },
        options.inner_iterations, options.min_step_m, options.min_step_rad);
    return state;
  };
}

}  // namespace edgescout
