#include "host/pipeline.h"

#include <array>

#include "host/detect/detect.h"
#include "host/detect/join_views.h"
#include "host/detect/support_views.h"
#include "host/enlarged_view.h"
#include "host/io/depth_registration.h"
#include "host/io/image.h"
#include "host/register/measured_depth.h"

namespace edgescout {

void describe(PipelineOptions& o, OptionVisitor& visit) {
  describe(o.edges, visit);
  describe(o.tensor, visit);
  describe(o.detect, visit);
  describe(o.detect.scan.world, visit);
  describe(o.detect.edge_claims, visit);
}

void PipelineOptions::validate() const {
  edges.validate();
  tensor.validate();
  detect.validate();
}

ObjectView undistorted_view(const Image& image, const Camera& camera,
                            const Se3& camera_from_world) {
  ObjectView view;
  view.camera = undistorted(camera);
  view.camera_from_world = camera_from_world;
  view.image = std::make_shared<Image>(undistort(image, camera));
  return view;
}

void add_depth(ObjectView& view, const DepthImage& depth, const Camera& camera,
               const DepthNoise& noise) {
  view.depth =
      std::make_shared<const MeasuredDepth>(MeasuredDepth{undistort_depth(depth, camera), noise});
}

void add_edges(ObjectView& view, Backend& backend, const EdgesOptions& options) {
  view.edges = std::make_shared<EdgeIndex>(find_edges(*view.image, options, backend),
                                           view.camera.width, view.camera.height);
}

ObjectView prepare_view(const Image& image, const Camera& camera, const Se3& camera_from_world,
                        Backend& backend, const PipelineOptions& options,
                        std::vector<StageSeconds>* stages) {
  std::vector<StageSeconds> unread;
  Stopwatch watch(stages ? *stages : unread, backend);
  ObjectView view = undistorted_view(image, camera, camera_from_world);
  watch.lap("undistort");
  add_edges(view, backend, options.edges);
  watch.lap("edges");
  return view;
}

std::vector<EdgeModel> models_of(std::span<const TemplateSet> sets) {
  std::vector<EdgeModel> models;
  for (const TemplateSet& set : sets) models.push_back(set.model);
  return models;
}

namespace {

// The options for enlarged images.
DetectOptions enlarged(DetectOptions options, int factor) {
  ImageRegion& within = options.scan.within;
  for (double* const px : {&within.x, &within.y, &within.width, &within.height}) *px *= factor;
  return options;
}

// The options for a view whose world becomes its camera frame.
DetectOptions in_camera_frame(DetectOptions options, const Se3& camera_from_world) {
  Se3& prior_from_world = options.scan.world.prior_from_world;
  prior_from_world = prior_from_world * inverse(camera_from_world);
  return options;
}

}  // namespace

Completion completion_under(const TimeLimit& limit) {
  if (limit.is_cancelled()) return Completion::Cancelled;
  return limit.is_over() ? Completion::DeadlinePassed : Completion::Complete;
}

std::string to_string(Completion completion) {
  constexpr std::array names{"complete", "deadline passed", "cancelled"};
  return names[std::size_t(completion)];
}

Detections detect_objects(const ObjectView& prepared, std::span<const TemplateSet> sets,
                          Backend& backend, const PipelineOptions& options, DetectTrace* trace) {
  options.validate();
  const TimeLimit limit = latched(options.limit);
  if (trace) *trace = {};
  Detections result;
  Stopwatch watch(result.stages, backend);
  const int factor = enlargement_for(sets, {&prepared, 1}, options.detect.enlarge_below_px);
  ObjectView view = enlarged({&prepared, 1}, factor, backend, options.edges)[0];
  watch.lap("enlargement");
  add_tensors(view, sets, backend, options.tensor);
  view.camera_from_world = Se3{};  // one view: its camera frame is the world
  const DetectOptions in_camera =
      in_camera_frame(enlarged(options.detect, factor), prepared.camera_from_world);
  watch.lap("tensors");
  if (trace)
    trace->view = view, trace->camera = prepared.camera, trace->world = in_camera.scan.world;
  std::vector<PoseEstimate> candidates;
  for (std::size_t object = 0; object < sets.size(); ++object)
    for (PoseEstimate& candidate :
         find_candidates({sets[object], view, {}, backend, &watch, &limit}, {}, in_camera,
                         trace ? &trace->searches.emplace_back() : nullptr)) {
      candidate.object = int(object);
      candidates.push_back(std::move(candidate));
    }
  const std::vector<EdgeModel> models = models_of(sets);
  SelectionTrace selection;
  result.detections = select_detections({models, {&view, 1}, backend, &limit}, sets, candidates,
                                        in_camera, &selection);
  if (trace) trace->selection = std::move(selection);
  watch.lap("selection");
  result.completion = completion_under(limit);
  return result;
}

Detections detect_jointly(std::span<const ObjectView> prepared, std::span<const TemplateSet> sets,
                          Backend& backend, const PipelineOptions& options) {
  options.validate();
  const TimeLimit limit = latched(options.limit);
  Detections result;
  Stopwatch watch(result.stages, backend);
  const int factor = enlargement_for(sets, prepared, options.detect.enlarge_below_px);
  std::vector<ObjectView> views = enlarged(prepared, factor, backend, options.edges);
  watch.lap("enlargement");
  for (ObjectView& view : views) add_tensors(view, sets, backend, options.tensor);
  watch.lap("tensors");
  const DetectOptions detect = enlarged(options.detect, factor);
  Grid<std::vector<PoseEstimate>> candidates(views.size(), sets.size());
  for (std::size_t v = 0; v < views.size(); ++v) {
    const std::vector<ObjectView> others = all_but(views, v);
    for (std::size_t object = 0; object < sets.size(); ++object)
      candidates(v, object) =
          find_candidates({sets[object], views[v], others, backend, &watch, &limit}, {}, detect);
  }
  const std::vector<EdgeModel> models = models_of(sets);
  result.detections = join_views({models, views, backend, &limit}, sets, candidates, detect);
  watch.lap("joint refinement");
  result.completion = completion_under(limit);
  return result;
}

}  // namespace edgescout
