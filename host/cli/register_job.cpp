#include "host/cli/register_job.h"

#include <fmt/format.h>

#include <algorithm>

#include "host/core/log.h"
#include "host/core/stopwatch.h"
#include "host/detect/detect.h"
#include "host/io/image.h"
#include "host/register/pose_classifier.h"

namespace edgescout {

namespace {

PreparedView prepare(const InputImage& input, bool is_single, Backend& backend,
                     const RegisterOptions& options) {
  const Image image = read_image(input);
  const Camera camera = camera_of(input, image.width, image.height,
                                  {options.camera, options.calibration.file, options.scale_camera});
  const Se3 camera_from_world = is_single ? Se3{} : *input.camera_from_world;
  PreparedView prepared;
  prepared.view = naming(input, [&] {
    return prepare_view(image, camera, camera_from_world, backend, options.pipeline,
                        &prepared.stages);
  });
  return prepared;
}

// Returns the size in this view of the smallest object at its start; the image's size if all
// objects are behind the camera.
double smallest_size_px(std::span<const ObjectPose> starts, const ObjectView& view,
                        std::span<const RegisterModel> models) {
  double smallest = std::max(view.camera.width, view.camera.height);
  for (const ObjectPose& start : starts) {
    const EdgeModel& model = models[static_cast<std::size_t>(start.object)].edges;
    const double depth_m =
        (view.camera_from_world * (start.world_from_object * model.center_m)).z();
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

void warn_of_out_of_sight(const ReadyJob& ready, std::size_t start, const RegisterModel& model) {
  const InputImage& input = ready.job->views[ready.job->starts[start].view];
  log(LogLevel::Warning, fmt::format("{}: object {}: found a start that no image shows, expected "
                                     "one in sight (lengths are in mm in a BOP results CSV, in m "
                                     "in JSON)",
                                     input.file.string(), model.object_id));
}

std::vector<ObjectView> views_with_tensors(const ReadyJob& ready,
                                           std::span<const RegisterModel> models, Backend& backend,
                                           const TensorOptions& options) {
  std::vector<ObjectView> views;
  for (std::size_t i = 0; i < ready.views.size(); ++i) {
    ObjectView& view = views.emplace_back(ready.views[i].view);
    const double reduction = reduction_for(smallest_size_px(ready.starts, view, models));
    naming(ready.job->views[i], [&] { add_tensors(view, reduction, backend, options); });
  }
  return views;
}

}  // namespace

ReadyJob prepare_job(const RegisterJob& job, Backend& backend, const RegisterOptions& options) {
  ReadyJob ready{&job, {}, {}};
  for (const InputImage& view : job.views)
    ready.views.push_back(prepare(view, job.views.size() == 1, backend, options));
  for (const RegisterJob::Start& start : job.starts)
    ready.starts.push_back({start.model, inverse(ready.views[start.view].view.camera_from_world) *
                                             start.camera_from_object});
  return ready;
}

Detections refine_job(const ReadyJob& ready, std::span<const RegisterModel> models,
                      std::span<const EdgeModel> edge_models, Backend& backend,
                      const RegisterOptions& options) {
  Detections result;
  result.stages = stages_of(ready.views);
  Stopwatch watch(result.stages, backend);
  const std::vector<ObjectView> views =
      views_with_tensors(ready, models, backend, options.pipeline.tensor);
  watch.lap("tensors");
  const std::vector<PoseEstimate> refined =
      refine_poses({edge_models, views, backend}, ready.starts, options.refine);
  watch.lap("registration");
  for (std::size_t i = 0; i < refined.size(); ++i) {
    const ObjectPose& start = ready.starts[i];
    const RegisterModel& model = models[static_cast<std::size_t>(start.object)];
    Detection& found = result.detections.emplace_back(to_detection(refined[i]));
    if (!is_out_of_sight(views, start, model.edges, pool_over_views(refined[i].features))) continue;
    found.probability = 0;
    found.convergence = OUT_OF_SIGHT;
    warn_of_out_of_sight(ready, i, model);
  }
  return result;
}

ImageResult result_of(const ReadyJob& ready, std::size_t view, const Detections& found,
                      std::span<const RegisterModel> models, const Backend& backend) {
  ImageResult result = begin_result(ready.job->views[view], ready.views[view].view, found, backend);
  for (const RegisterModel& model : models)
    result.objects.push_back({model.object_id, model.edges.mesh.name});
  for (std::size_t i = 0; i < found.detections.size(); ++i)
    if (ready.job->starts[i].view == view) result.detections.push_back(found.detections[i]);
  if (ready.views.size() == 1) carry_to_world(result);
  return result;
}

}  // namespace edgescout
