#include "host/bridge/ros2/object_search.h"

#include <algorithm>

#include "host/overlay.h"
#include "kernels/error.h"

namespace edgescout::ros2 {

std::span<const TemplateSet> ObjectSearch::sets(const Camera& camera,
                                                const IsCancelled& is_cancelled) {
  if (sets_.empty()) {
    sets_ = templates_(camera, is_cancelled);
    models_ = models_of(sets_);
    names_ = class_names(sets_);
  }
  return sets_;
}

ObjectView ObjectSearch::prepared(const CameraView& view, const PipelineOptions& options) {
  ObjectView result =
      prepare_view(view.image, view.camera, view.camera_from_world, backend_, options);
  result.depth = view.depth;
  return result;
}

Detections ObjectSearch::in_image(const CameraView& view, const TimeLimit& limit) {
  sets(view.camera, limit.cancelled);
  PipelineOptions options = options_;
  options.limit = limit;
  last_view_ = prepared(view, options);
  return detect_objects(last_view_, sets_, backend_, options);
}

RgbImage ObjectSearch::overlay(std::span<const Detection> detections) {
  std::vector<OverlayPose> poses;
  for (const Detection& detection : detections)
    poses.push_back({detection.object, detection.world_from_object, detection.probability,
                     names_[std::size_t(detection.object)]});
  return draw_overlay(*last_view_.image, last_view_.camera, poses, models_, last_view_.edges.get(),
                      backend_);
}

std::vector<DepthWarning> ObjectSearch::depth_warnings() const {
  return check_depth(last_view_, surface_distances_m(sets_));
}

const ObjectSearch::Chosen& ObjectSearch::chosen(std::span<const std::uint64_t> object_ids) {
  if (!chosen_.ids.empty() && std::ranges::equal(chosen_.ids, object_ids)) return chosen_;
  Chosen chosen{{object_ids.begin(), object_ids.end()}, {}, {}};
  std::string known;
  for (const TemplateSet& set : sets_)
    known += (known.empty() ? "" : ", ") + std::to_string(set.object_id);
  for (const std::uint64_t id : object_ids)
    if (std::ranges::none_of(
            sets_, [&](const TemplateSet& set) { return std::uint64_t(set.object_id) == id; }))
      throw InputError("request", "object_ids", std::to_string(id), "one of " + known);
  for (std::size_t i = 0; i < sets_.size(); ++i)
    if (std::ranges::find(object_ids, std::uint64_t(sets_[i].object_id)) != object_ids.end()) {
      chosen.sets.push_back(sets_[i]);
      chosen.index.push_back(int(i));
    }
  return chosen_ = std::move(chosen);
}

Detections ObjectSearch::in_views(std::span<const CameraView> views,
                                  std::span<const std::uint64_t> object_ids,
                                  const TimeLimit& limit) {
  if (views.empty()) throw InputError("request", "cameras", "none", "at least one");
  sets(views[0].camera, limit.cancelled);
  const Chosen* some = object_ids.empty() ? nullptr : &chosen(object_ids);
  PipelineOptions options = options_;
  options.limit = limit;
  std::vector<ObjectView> all;
  for (const CameraView& view : views) all.push_back(prepared(view, options));
  Detections found = detect_jointly(all, some ? some->sets : sets_, backend_, options);
  if (some)
    for (Detection& detection : found.detections)
      detection.object = some->index[std::size_t(detection.object)];
  return found;
}

}  // namespace edgescout::ros2
