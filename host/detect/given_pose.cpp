#include "host/detect/given_pose.h"

#include <algorithm>
#include <cmath>

#include "host/register/thresholds.h"

namespace edgescout {

namespace {

Object object_of(const TemplateSet& set) { return {set.object_id, set.model.mesh, set.symmetries}; }

// Compares hits with the given pose. Those that pass lie so near that alignment should move them
// there: no corner of the object's box is further from its place in the image than a quarter of the
// object's size there (thresholds::NEAR_GIVEN).
SamePose near_the(const ObjectPose& given, const TemplateSet& set, const Camera& camera) {
  Object box = object_of(set);
  const Mesh& mesh = set.model.mesh;
  box.mesh.vertices_m.clear();
  for (const double x_m : {mesh.box_min_m.x(), mesh.box_max_m.x()})
    for (const double y_m : {mesh.box_min_m.y(), mesh.box_max_m.y()})
      for (const double z_m : {mesh.box_min_m.z(), mesh.box_max_m.z()})
        box.mesh.vertices_m.emplace_back(x_m, y_m, z_m);
  const double distance_m = (given.world_from_object * set.model.center_m).norm();
  SamePoseOptions near;
  near.max_mspd_px = thresholds::NEAR_GIVEN * mesh.diameter_m * camera.fx / distance_m;
  return {box, camera, given.world_from_object, near};
}

}  // namespace

double rank_of(const PoseEstimate& pose) { return pose.classification.rank; }
double probability_of(const PoseEstimate& pose) { return pose.classification.probability; }

std::size_t HeldPoses::count_same() const {
  return std::size_t(std::ranges::count_if(of_bounds, [](double error) { return error < 1; }));
}

std::optional<std::size_t> HeldPoses::nearest() const {
  const auto least = std::ranges::min_element(of_bounds);
  if (least == of_bounds.end()) return std::nullopt;
  return std::size_t(least - of_bounds.begin());
}

GivenPose::GivenPose(const TemplateSet& set, const Camera& camera, const ObjectPose& given,
                     const SamePoseOptions& same)
    : given_(given),
      is_same_(object_of(set), camera, given.world_from_object, same),
      is_near_(near_the(given, set, camera)) {}

double GivenPose::of_bounds(const ObjectPose& pose) const {
  return pose.object == given_.object ? is_same_.of_bounds(pose.world_from_object) : INFINITY;
}

ComparedStages GivenPose::compared(const DetectTrace& trace) const {
  const SearchTrace& search = trace.searches[std::size_t(given_.object)];
  return {of_search(search.medium), of_search(search.candidates), of_search(search.fine),
          compared(trace.selection.competing), trace.selection};
}

HeldPoses GivenPose::compared(std::vector<PoseEstimate> poses) const {
  HeldPoses held{std::move(poses), {}};
  for (const PoseEstimate& pose : held.poses) held.of_bounds.push_back(of_bounds(pose));
  return held;
}

HeldPoses GivenPose::of_search(std::vector<PoseEstimate> poses) const {
  for (PoseEstimate& pose : poses) pose.object = given_.object;
  return compared(std::move(poses));
}

FoundPose GivenPose::found(const PoseEstimate& pose) const {
  const Se3& camera_from_object = pose.world_from_object;
  const bool is_other = pose.object != given_.object;
  return {pose, is_other ? PoseError{} : is_same_.error(camera_from_object),
          is_other ? 0 : is_same_.mspd_px(camera_from_object), probability_of(pose),
          pose.classification.pooled};
}

std::optional<FoundPose> GivenPose::found(const HeldPoses& held,
                                          std::optional<std::size_t> index) const {
  return index ? std::optional(found(held.poses[*index])) : std::nullopt;
}

}  // namespace edgescout
