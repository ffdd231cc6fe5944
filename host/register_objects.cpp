#include "host/register_objects.h"

#include <algorithm>

#include "host/detect/detect.h"
#include "host/register/move_onto_depth.h"
#include "host/register/pose_classifier.h"

namespace edgescout {

namespace {

// Returns the size in this view of the smallest object at its pose; the image's size if all objects
// are behind the camera.
double smallest_size_px(std::span<const ObjectPose> poses, const ObjectView& view,
                        std::span<const EdgeModel> models) {
  double smallest = std::max(view.camera.width, view.camera.height);
  for (const ObjectPose& pose : poses) {
    const EdgeModel& model = models[std::size_t(pose.object)];
    const double depth_m = (view.camera_from_world * (pose.world_from_object * model.center_m)).z();
    if (depth_m > 0)
      smallest = std::min(smallest, model.mesh.diameter_m / depth_m * view.camera.fx);
  }
  return smallest;
}

// Returns whether the object's bounding sphere reaches into the image. Its projection is longer the
// farther it is from the optical axis.
bool reaches_into(const ObjectView& view, const EdgeModel& model, const Se3& world_from_object) {
  const Camera& camera = view.camera;
  const Eigen::Vector3d center_m = view.camera_from_world * (world_from_object * model.center_m);
  if (!(center_m.z() > 0)) return false;
  const Eigen::Vector2d center_px = project(camera, center_m);
  const double depth_m = center_m.z(), longer = center_m.norm() / depth_m,
               radius_px = model.radius_m / depth_m * std::max(camera.fx, camera.fy) * longer;
  return center_px.x() > -radius_px && center_px.x() < camera.width + radius_px &&
         center_px.y() > -radius_px && center_px.y() < camera.height + radius_px;
}

// A start outside of every image could be registered to any edge, however far away. An object of a
// few pixels fits everywhere.
bool is_out_of_sight(std::span<const ObjectView> views, const ObjectPose& start,
                     const EdgeModel& model, const PoseFeatures& refined) {
  constexpr double least_px = 20;  // of visible edges, summed over all images
  return refined.length_px < least_px || std::ranges::none_of(views, [&](const ObjectView& view) {
           return reaches_into(view, model, start.world_from_object);
         });
}

}  // namespace

void RegisterObjectsOptions::validate() const {
  tensor.validate();
  refine.validate();
}

void describe(RegistrationOptions& options, OptionVisitor& visit) {
  describe(options.work.refine, visit);
  describe(options.edges, visit);
  describe(options.work.tensor, visit);
}

Detections register_objects(std::span<const ObjectView> prepared, std::span<const EdgeModel> models,
                            std::span<const ObjectPose> starts, Backend& backend,
                            const RegisterObjectsOptions& options) {
  options.validate();
  check_problem(starts, models.size(), prepared);
  const TimeLimit limit = latched(options.limit);
  Detections result;
  Stopwatch watch(result.stages, backend);
  std::vector<ObjectView> views(prepared.begin(), prepared.end());
  for (ObjectView& view : views)
    add_tensors(view, reduction_for(smallest_size_px(starts, view, models)), backend,
                options.tensor);
  watch.lap("tensors");
  const Scene scene{models, views, backend, &limit};
  std::vector<ObjectPose> moved;
  for (const ObjectPose& start : starts) moved.push_back(moved_onto_depth(scene, start));
  const std::vector<PoseEstimate> refined = refine_poses(scene, moved, options.refine);
  watch.lap("registration");
  for (std::size_t i = 0; i < refined.size(); ++i) {
    Detection& found = result.detections.emplace_back(to_detection(refined[i]));
    if (!is_out_of_sight(views, starts[i], models[std::size_t(starts[i].object)],
                         refined[i].classification.pooled))
      continue;
    found.probability = 0;
    found.convergence = OUT_OF_SIGHT;
  }
  result.completion = completion_under(limit);
  return result;
}

}  // namespace edgescout
