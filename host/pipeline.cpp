#include "host/pipeline.h"

#include <algorithm>
#include <cmath>

#include "host/core/stopwatch.h"
#include "host/detect/joint.h"
#include "host/detect/support_views.h"
#include "host/io/image.h"
#include "kernels/error.h"

namespace edgescout {

namespace {

// Typical size of an object in the image: at the geometric middle of its distances.
double size_px(const TemplateSet& set, const Camera& camera) {
  return set.model.mesh.diameter_m /
         std::sqrt(set.options.distance_min_m * set.options.distance_max_m) * camera.fx;
}

double smallest_size_px(std::span<const TemplateSet> sets, const Camera& camera) {
  check(!sets.empty(), "pipeline: no templates");
  double smallest = size_px(sets[0], camera);
  for (const TemplateSet& set : sets) smallest = std::min(smallest, size_px(set, camera));
  return smallest;
}

}  // namespace

void PipelineOptions::validate() const {
  edges.validate();
  tensor.validate();
  detect.validate();
}

PreparedImage prepare_image(const Image& image, const Camera& camera, const Se3& camera_from_world,
                            Backend& backend, const PipelineOptions& options) {
  PreparedImage prepared;
  Stopwatch watch(prepared.stages);
  prepared.image = undistort(image, camera);
  prepared.camera = undistorted(camera);
  prepared.camera_from_world = camera_from_world;
  watch.lap("undistort");
  prepared.edges = find_edges(prepared.image, options.edges, backend);
  watch.lap("edges");
  return prepared;
}

std::vector<EdgeModel> models_of(std::span<const TemplateSet> sets) {
  std::vector<EdgeModel> models;
  for (const TemplateSet& set : sets) models.push_back(set.model);
  return models;
}

Observation observe_prepared(const PreparedImage& prepared, std::span<const TemplateSet> sets,
                             Backend& backend, const PipelineOptions& options) {
  return observe(prepared.image, prepared.camera, prepared.camera_from_world, prepared.edges,
                 reduction_for(smallest_size_px(sets, prepared.camera)), options.tensor, backend);
}

Detections detect_objects(const PreparedImage& prepared, std::span<const TemplateSet> sets,
                          Backend& backend, const PipelineOptions& options) {
  options.validate();
  Detections result;
  result.stages = prepared.stages;
  Stopwatch watch(result.stages);
  const Observation observation = observe_prepared(prepared, sets, backend, options);
  watch.lap("tensors");
  std::vector<ObjectPose> poses;
  std::vector<Refined> candidates;
  for (std::size_t object = 0; object < sets.size(); ++object)
    for (const Refined& candidate :
         find_candidates(sets[object], observation, backend, options.detect)) {
      poses.push_back({int(object), candidate.registration.world_from_object});
      candidates.push_back(candidate);
    }
  watch.lap("candidates");
  RegisterView view = observation.view;
  view.camera_from_world = Se3{};  // one view: its camera frame is the world
  result.detections = select_detections(models_of(sets), poses, candidates,
                                        std::vector<RegisterView>{view}, backend, options.detect);
  watch.lap("settle");
  return result;
}

Detections detect_jointly(std::span<const PreparedImage> views, std::span<const TemplateSet> sets,
                          Backend& backend, const PipelineOptions& options) {
  options.validate();
  Detections result;
  for (const PreparedImage& view : views)
    result.stages.insert(result.stages.end(), view.stages.begin(), view.stages.end());
  Stopwatch watch(result.stages);
  std::vector<Observation> observations;
  for (const PreparedImage& view : views)
    observations.push_back(observe_prepared(view, sets, backend, options));
  watch.lap("tensors");
  std::vector<std::vector<std::vector<Refined>>> candidates(observations.size());  // [view][object]
  for (std::size_t v = 0; v < observations.size(); ++v) {
    const std::vector<Observation> others = all_but(observations, v);
    for (const TemplateSet& set : sets)
      candidates[v].push_back(
          find_candidates(set, observations[v], others, {}, backend, options.detect));
  }
  watch.lap("candidates");
  result.detections =
      join_views(sets, models_of(sets), candidates, observations, backend, options.detect);
  watch.lap("joint refinement");
  return result;
}

}  // namespace edgescout
