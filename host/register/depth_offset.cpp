#include "host/register/depth_offset.h"

#include <cmath>

#include "host/register/depth_evidence.h"
#include "host/register/edge_icp.h"
#include "host/register/measured_depth.h"
#include "host/register/thresholds.h"
#include "host/register/visible_in_views.h"

namespace edgescout {

namespace {

// The variance of a point's movement along a unit vector, world frame.
double variance_along(const Eigen::Vector3d& ray, const PoseEstimate& pose,
                      const Eigen::Vector3d& point_m) {
  Vector6d jacobian;
  jacobian << ray, (pose.world_from_object.rotation * point_m).cross(ray);
  return jacobian.dot(pose.covariance * jacobian);
}

// A view that has not been through a detection has no values on the backend yet.
Grid<DepthEvidence> evidence_in(std::span<const EdgeModel> models, const ObjectView& view,
                                Backend& backend, std::span<const ObjectPose> poses) {
  ObjectView measured = view;
  const DepthImage& depth = view.depth->image;
  measured.depth_values =
      backend.make_depth({depth.z_m, depth.width, depth.height, intrinsics_of(view.camera)});
  const Scene scene{models, {&measured, 1}, backend};
  return depth_evidence(scene, poses, visible_in_views(scene, poses));
}

}  // namespace

std::vector<DepthOffset> depth_offsets(std::span<const EdgeModel> models, const ObjectView& view,
                                       Backend& backend, std::span<const ObjectPose> poses) {
  constexpr double most_moved = 0.2, most_turned_rad = 0.2;  // of the diameter
  const Grid<DepthEvidence> evidence = evidence_in(models, view, backend, poses);
  ObjectView edges_alone = view;
  edges_alone.depth = nullptr;
  edges_alone.depth_values = nullptr;
  std::vector<PoseEstimate> alone(poses.size());
  for (std::size_t i = 0; i < poses.size(); ++i) static_cast<ObjectPose&>(alone[i]) = poses[i];
  edge_icp({models, {&edges_alone, 1}, backend}, alone, {});
  const Eigen::Vector3d eye_m = inverse(view.camera_from_world).translation_m;
  std::vector<DepthOffset> offsets;
  for (std::size_t i = 0; i < poses.size(); ++i) {
    const PoseEstimate& by_edges = alone[i];
    const EdgeModel& model = models[std::size_t(poses[i].object)];
    const Eigen::Vector3d center_m = poses[i].world_from_object * model.center_m,
                          moved_m = center_m - by_edges.world_from_object * model.center_m,
                          ray = (center_m - eye_m).normalized();
    const double variance = variance_along(ray, by_edges, model.center_m);
    const bool is_held = by_edges.convergence == Convergence::Converged ||
                         by_edges.convergence == Convergence::NoDecrease ||
                         by_edges.convergence == Convergence::IterationLimit;
    const double samples = evidence(i, 0).agreeing + evidence(i, 0).contradicting;
    if (!is_held || samples < thresholds::MIN_DEPTH_SAMPLES || !std::isfinite(variance) ||
        moved_m.norm() > most_moved * model.mesh.diameter_m ||
        angle_between_rad(poses[i].world_from_object, by_edges.world_from_object) > most_turned_rad)
      continue;
    offsets.push_back({ray.dot(moved_m), std::sqrt(variance)});
  }
  return offsets;
}

}  // namespace edgescout
