// The whole flow on one screen: image -> edges -> tensors -> template scan -> candidates ->
// registration -> detections.
//
// This is the library's front door. A robot's program loads meshes (io/mesh.h), builds template
// sets once (model/template_set.h), makes a backend (kernels/backend.h) and calls detect_objects
// for each image.
#pragma once

#include <span>
#include <vector>

#include "host/core/types.h"
#include "host/detect/detect.h"
#include "host/edge/edges.h"
#include "host/io/results.h"
#include "host/model/template_set.h"

namespace edgescout {

struct PipelineOptions {
  EdgesOptions edges;
  TensorOptions tensor;
  DetectOptions detect;
  void validate() const;
};

// An image undistorted, with the edges found in it: all of the work that does not depend on the
// models. It may be prepared for the next image by one thread while another detects in this one, if
// each has a backend of its own.
struct PreparedImage {
  Image image;    // undistorted
  Camera camera;  // ideal
  Se3 camera_from_world;
  std::vector<EdgePoint> edges;
  std::vector<StageSeconds> stages;
};
PreparedImage prepare_image(const Image& image, const Camera& camera, const Se3& camera_from_world,
                            Backend& backend, const PipelineOptions& options);

// Its tensors, the coarse one reduced as suits the smallest of the objects.
Observation observe_prepared(const PreparedImage& prepared, std::span<const TemplateSet> sets,
                             Backend& backend, const PipelineOptions& options);

std::vector<EdgeModel> models_of(std::span<const TemplateSet> sets);

struct Detections {
  // best probability first; world_from_object is camera_from_object for one view
  std::vector<Detection> detections;
  std::vector<StageSeconds> stages;  // in the order they ran
};

// All objects in one view.
Detections detect_objects(const PreparedImage& prepared, std::span<const TemplateSet> sets,
                          Backend& backend, const PipelineOptions& options);

// All objects in several calibrated views of one static scene: candidates of every view, each
// refined over all views (Eq. 11).
Detections detect_jointly(std::span<const PreparedImage> views, std::span<const TemplateSet> sets,
                          Backend& backend, const PipelineOptions& options);

}  // namespace edgescout
