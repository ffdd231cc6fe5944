#include "host/cli/register_job.h"

#include <fmt/format.h>

#include <algorithm>

#include "host/cli/view_results.h"
#include "host/core/log.h"
#include "host/core/stopwatch.h"
#include "host/detect/observation.h"
#include "host/io/image.h"

namespace edgescout {

namespace {

PreparedImage prepare_view(const InputImage& input, bool is_alone, Backend& backend,
                           const RegisterOptions& options) {
  const Image image = load_image(input.file);
  const Camera camera = camera_of(input, image.width, image.height,
                                  {options.camera, options.camera_file, options.scale_camera});
  const Se3 camera_from_world = is_alone ? Se3{} : *input.camera_from_world;
  return naming(input, [&] {
    return prepare_image(image, camera, camera_from_world, backend, options.pipeline);
  });
}

// Of the smallest object as the starts have it in this view; the image's size where none is in
// front of it.
double smallest_size_px(const ReadyJob& ready, const PreparedImage& view,
                        std::span<const RegisterModel> models) {
  double smallest = std::max(view.camera.width, view.camera.height);
  for (const ObjectPose& start : ready.starts) {
    const EdgeModel& model = models[static_cast<std::size_t>(start.object)].edges;
    const double depth_m =
        (view.camera_from_world * (start.world_from_object * model.center_m)).z();
    if (depth_m > 0)
      smallest = std::min(smallest, model.mesh.diameter_m / depth_m * view.camera.fx);
  }
  return smallest;
}

// Whether the object's bounding sphere does, which looks longer the farther from the axis it is.
bool reaches_into(const PreparedImage& view, const EdgeModel& model, const Se3& world_from_object) {
  const Camera& camera = view.camera;
  const Eigen::Vector3d center_m = view.camera_from_world * (world_from_object * model.center_m);
  if (!(center_m.z() > 0)) return false;
  const Eigen::Vector2d center_px = project(camera, center_m);
  const double depth_m = center_m.z(), longer = center_m.norm() / depth_m,
               radius_px = model.radius_m / depth_m * std::max(camera.fx, camera.fy) * longer;
  return center_px.x() > -radius_px && center_px.x() < camera.width + radius_px &&
         center_px.y() > -radius_px && center_px.y() < camera.height + radius_px;
}

// What starts outside of every image is drawn to anything inside, however far away; what is a speck
// fits everywhere.
bool is_out_of_sight(const ReadyJob& ready, const ObjectPose& start, const EdgeModel& model,
                     const PoseFeatures& refined) {
  constexpr double least_px = 20;  // of visible edges, in all images together
  return refined.length_px < least_px ||
         std::ranges::none_of(ready.views, [&](const PreparedImage& view) {
           return reaches_into(view, model, start.world_from_object);
         });
}

void tell_out_of_sight(const ReadyJob& ready, std::size_t start, const RegisterModel& model) {
  const InputImage& input = ready.job->views[ready.job->starts[start].view];
  log(LogLevel::Warning, fmt::format("{}: object {}: found a start that no image shows, expected "
                                     "one in sight (lengths are in mm "
                                     "in a BOP results CSV, in m in JSON)",
                                     input.file.string(), model.object_id));
}

}  // namespace

ReadyJob prepare_job(const RegisterJob& job, Backend& backend, const RegisterOptions& options) {
  ReadyJob ready{&job, {}, {}};
  for (const InputImage& view : job.views)
    ready.views.push_back(prepare_view(view, job.views.size() == 1, backend, options));
  for (const RegisterJob::Start& start : job.starts)
    ready.starts.push_back({start.model, inverse(ready.views[start.view].camera_from_world) *
                                             start.camera_from_object});
  return ready;
}

Detections refine_job(const ReadyJob& ready, std::span<const RegisterModel> models,
                      std::span<const EdgeModel> edge_models, Backend& backend,
                      const RegisterOptions& options) {
  Detections result;
  for (const PreparedImage& view : ready.views)
    result.stages.insert(result.stages.end(), view.stages.begin(), view.stages.end());
  Stopwatch watch(result.stages);
  std::vector<RegisterView> views;
  for (std::size_t i = 0; i < ready.views.size(); ++i) {
    const PreparedImage& view = ready.views[i];
    const double reduction = reduction_for(smallest_size_px(ready, view, models));
    views.push_back(naming(ready.job->views[i], [&] {
                      return observe(view.image, view.camera, view.camera_from_world, view.edges,
                                     reduction, options.pipeline.tensor, backend);
                    }).view);
  }
  watch.lap("tensors");
  const std::vector<Refined> refined =
      refine_poses(edge_models, ready.starts, views, backend, options.refine);
  watch.lap("registration");
  for (std::size_t i = 0; i < refined.size(); ++i) {
    const ObjectPose& given = ready.starts[i];
    const RegisterModel& model = models[static_cast<std::size_t>(given.object)];
    Detection& found = result.detections.emplace_back(
        to_detection(given.object, refined[i].registration, refined[i].features));
    if (!is_out_of_sight(ready, given, model.edges, refined[i].features)) continue;
    found.probability = 0;
    found.convergence = OUT_OF_SIGHT;
    tell_out_of_sight(ready, i, model);
  }
  return result;
}

ImageResult result_of(const ReadyJob& ready, std::size_t view, const Detections& found,
                      std::span<const RegisterModel> models, const Backend& backend) {
  ImageResult result = begin_result(ready.job->views[view], ready.views[view], found, backend);
  for (const RegisterModel& model : models)
    result.objects.push_back({model.object_id, model.edges.mesh.name});
  for (std::size_t i = 0; i < found.detections.size(); ++i)
    if (ready.job->starts[i].view == view) result.detections.push_back(found.detections[i]);
  if (ready.views.size() == 1) carry_to_world(result);
  return result;
}

}  // namespace edgescout
