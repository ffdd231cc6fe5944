// Finds the objects in images: templates, backend and options in one place.
#pragma once

#include <functional>
#include <map>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "host/bridge/ros2/detection_message.h"
#include "host/core/types.h"
#include "host/detect/depth_check.h"
#include "host/io/image.h"
#include "host/pipeline.h"
#include "host/register/measured_depth.h"

namespace edgescout::ros2 {

using IsCancelled = std::function<bool()>;

// Reads or builds the templates for images of a camera: default distances depend on it. May throw
// Cancelled where it is.
using TemplateSource =
    std::function<std::vector<TemplateSet>(const Camera&, const IsCancelled& is_cancelled)>;

struct CameraView {
  Image image;
  Camera camera;
  Se3 camera_from_world;
  std::shared_ptr<const MeasuredDepth> depth;  // null: none
};

class ObjectSearch {
 public:
  ObjectSearch(TemplateSource templates, Backend& backend, const PipelineOptions& options)
      : templates_(std::move(templates)), backend_(backend), options_(options) {}

  // The templates of all objects, made at the first call.
  std::span<const TemplateSet> sets(const Camera& camera, const IsCancelled& is_cancelled);
  DetectedObjects objects() const { return {sets_, names_}; }
  Backend& backend() { return backend_; }

  // Poses in the camera's frame. Keeps the view for `overlay`.
  Detections in_image(const CameraView& view, const TimeLimit& limit);
  RgbImage overlay(std::span<const Detection> detections);
  // Of that view; none where it has no depth.
  std::vector<DepthWarning> depth_warnings() const;

  // Poses in the world, of the objects with these BOP ids; none: of all. InputError: no view, an id
  // without a model.
  Detections in_views(std::span<const CameraView> views, std::span<const std::uint64_t> object_ids,
                      const TimeLimit& limit);

 private:
  struct Chosen {
    std::vector<std::uint64_t> ids;
    std::vector<TemplateSet> sets;
    std::vector<int> index;  // of each in all sets
  };
  ObjectView prepared(const CameraView& view, const PipelineOptions& options);
  const Chosen& chosen(std::span<const std::uint64_t> object_ids);

  TemplateSource templates_;
  Backend& backend_;
  PipelineOptions options_;
  std::vector<TemplateSet> sets_;
  std::vector<EdgeModel> models_;
  std::vector<std::string> names_;
  Chosen chosen_;  // of the last call: as a rule the same again
  ObjectView last_view_;
};

}  // namespace edgescout::ros2
