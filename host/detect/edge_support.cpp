#include "host/detect/edge_support.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace edgescout {

namespace {

std::vector<ObjectPose> copies_beside(const Scene& scene, const ObjectPose& pose) {
  const ObjectView& view = scene.views[0];
  const Eigen::Vector3d& center_m = scene.models[std::size_t(pose.object)].center_m;
  const double depth_m = (view.camera_from_world * (pose.world_from_object * center_m)).z(),
               m_per_px = depth_m / view.camera.fx;
  std::vector<ObjectPose> copies;
  for (const double distance_px : {7.0, 14.0})
    for (int eighth = 0; eighth < 8; ++eighth) {
      const double direction_rad = eighth * std::numbers::pi / 4;
      const Eigen::Vector3d across(std::cos(direction_rad), std::sin(direction_rad), 0);
      copies.push_back(pose);
      copies.back().world_from_object.translation_m +=
          view.camera_from_world.rotation.conjugate() * (distance_px * m_per_px * across);
    }
  return copies;
}

}  // namespace

SupportedPoints count_supported(const Scene& scene, const ObjectPose& pose,
                         const EdgeClaimOptions& options) {
  const Scene seen{scene.models, scene.views.first(1), scene.backend};
  const PoseFeatures features = features_by_view(seen, {&pose, 1})(0, 0);
  SupportedPoints support;
  support.visible = features.visible;
  support.in_image = features.points;
  support.supported = supported_points(seen, pose, options);
  for (const ObjectPose& copy : copies_beside(seen, pose))
    support.supported_beside =
        std::max(support.supported_beside, supported_points(seen, copy, options));
  return support;
}

}  // namespace edgescout
