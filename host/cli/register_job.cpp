#include "host/cli/register_job.h"

#include <fmt/format.h>

#include <algorithm>

#include "host/core/log.h"
#include "host/io/image.h"
#include "host/register_objects.h"

namespace edgescout {

namespace {

PreparedView prepare(const InputImage& input, bool is_single, const DepthReader& depth,
                     Backend& backend, const RegisterOptions& options) {
  const Image image = read_image(input);
  const Camera camera = camera_of(input, image.width, image.height,
                                  {options.camera, options.calibration.file, options.scale_camera});
  const Se3 camera_from_world = is_single ? Se3{} : *input.camera_from_world;
  PreparedView prepared;
  prepared.view = naming(input, [&] {
    return prepare_view(image, camera, camera_from_world, backend, options.pipeline,
                        &prepared.stages);
  });
  prepared.view.depth = depth.read(input, camera, backend.threads());
  return prepared;
}

void warn_of_out_of_sight(const ReadyJob& ready, std::size_t start, const RegisterModel& model) {
  const InputImage& input = ready.job->views[ready.job->starts[start].view];
  log(LogLevel::Warning, fmt::format("{}: object {}: found a start that no image shows, expected "
                                     "one in sight (lengths are in mm in a BOP results CSV, in m "
                                     "in JSON)",
                                     input.file.string(), model.object_id));
}

}  // namespace

ReadyJob prepare_job(const RegisterJob& job, const DepthReader& depth, Backend& backend,
                     const RegisterOptions& options) {
  ReadyJob ready{&job, {}, {}};
  for (const InputImage& view : job.views)
    ready.views.push_back(prepare(view, job.views.size() == 1, depth, backend, options));
  for (const RegisterJob::Start& start : job.starts)
    ready.starts.push_back({start.model, inverse(ready.views[start.view].view.camera_from_world) *
                                             start.camera_from_object});
  return ready;
}

Detections refine_job(const ReadyJob& ready, std::span<const RegisterModel> models,
                      std::span<const EdgeModel> edge_models, Backend& backend,
                      const RegisterOptions& options) {
  std::vector<ObjectView> views;
  for (const PreparedView& prepared : ready.views) views.push_back(prepared.view);
  RegisterObjectsOptions objects;
  objects.tensor = options.pipeline.tensor;
  objects.refine = options.refine;
  objects.limit = limit_from_now(options.max_seconds);
  Detections result = naming(ready.job->views[0], [&] {
    return register_objects(views, edge_models, ready.starts, backend, objects);
  });
  for (std::size_t i = 0; i < result.detections.size(); ++i)
    if (result.detections[i].convergence == OUT_OF_SIGHT)
      warn_of_out_of_sight(ready, i, models[std::size_t(ready.starts[i].object)]);
  std::vector<StageSeconds> stages = stages_of(ready.views);
  std::ranges::move(result.stages, std::back_inserter(stages));
  result.stages = std::move(stages);
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
