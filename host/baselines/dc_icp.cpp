// DC-ICP: Liu, Tuzel, Veeraraghavan, Taguchi, Marks, Chellappa: Fast object localization and pose
// estimation in heavy clutter for robotic bin picking, IJRR 31(8), 2012. Their directional chamfer
// cost chooses the pairs. The distance in the image alone is minimised. Pairs are exact: place and
// direction of the points are not rounded. A map of the tensor's closest points would be rougher
// and faster.
#include <memory>

#include "host/baselines/icp.h"
#include "host/baselines/joint_index.h"
#include "kernels/error.h"

namespace edgescout {

PoseSolver prepare_dc_icp(std::span<const ObjectView> views, const BaselineOptions& options) {
  const auto indices = std::make_shared<std::vector<JointIndex>>();
  for (const ObjectView& view : views) {
    check(view.edges != nullptr, "dc-icp: a view without edge points");
    indices->emplace_back(view.edges->points_by_cell(), view.camera.width, view.camera.height,
                          view.tensor->options.lambda_px_per_rad);
  }
  const Associate associate = [indices](std::size_t v, double x_px, double y_px, double theta_rad) {
    return (*indices)[v].closest(float(x_px), float(y_px), float(theta_rad));
  };
  return [views, options, associate](const Se3& start,
                                     std::span<const std::vector<ModelPoint>> points) {
    return iterate_closest_points(start, views, points, associate, options);
  };
}

}  // namespace edgescout
