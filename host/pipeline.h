// The whole flow on one screen: image -> edges -> tensors -> template scan -> candidates ->
// registration -> detections.
//
// Programs start here. A robot's program loads meshes (io/mesh.h), builds template sets once
// (model/template_set.h), makes a backend (kernels/backend.h), prepares each image and calls
// detect_objects. add_tensors (detect/tensors.h) is for programs that run the stages themselves.
//
// Public header.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "host/core/depth_image.h"
#include "host/core/stopwatch.h"
#include "host/core/time_limit.h"
#include "host/detect/detect_options.h"
#include "host/detect/detect_trace.h"
#include "host/detect/tensors.h"
#include "host/edge/edges.h"
#include "host/model/template_set.h"

namespace edgescout {

struct PipelineOptions {
  EdgesOptions edges;
  TensorOptions tensor;
  DetectOptions detect;
  TimeLimit limit;  // of each detect_objects or detect_jointly
  void validate() const;
};

// Names every option of a detection to `visit`: the one list for command line, bindings and
// bridges. The limit is not among them: it holds for a call.
void describe(PipelineOptions& options, OptionVisitor& visit);

// Undistorts an image and returns its view, which has neither edges nor tensors yet. Needs no
// backend: it may run on another thread while a backend is in use.
ObjectView undistorted_view(const Image& image, const Camera& camera, const Se3& camera_from_world);

// Gives a view the depth image that belongs to its grey one, before add_tensors or detect_objects.
// `camera` is that of the grey image as it was taken, lens included; the depth image has the same
// or is registered to it (io/depth_registration.h: register_depth gives one of the undistorted
// camera, which is then `camera`). InputError: they differ in size.
void add_depth(ObjectView& view, const DepthImage& depth, const Camera& camera,
               const DepthNoise& noise = {});

// Finds the edges of an undistorted view and puts them into it.
void add_edges(ObjectView& view, Backend& backend, const EdgesOptions& options);

// Undistorts an image, finds its edges and returns the view: all work that does not depend on the
// models. The view has no tensors yet. One thread may prepare the next image while another thread
// detects in this one, if each has its own backend. `stages`, where given, gains the time of each
// stage.
ObjectView prepare_view(const Image& image, const Camera& camera, const Se3& camera_from_world,
                        Backend& backend, const PipelineOptions& options,
                        std::vector<StageSeconds>* stages = nullptr);

std::vector<EdgeModel> models_of(std::span<const TemplateSet> sets);

enum class Completion {
  Complete,
  DeadlinePassed,  // the limit was over before the work was: poses may be missing or unrefined
  Cancelled,
};
// Returns how work that has ended under this limit ended: cancelled, by the deadline or done.
Completion completion_under(const TimeLimit& limit);
std::string to_string(Completion completion);  // "complete", "deadline passed", "cancelled"

struct Detections {
  // Best probability first; the world is the camera frame for one view.
  std::vector<Detection> detections;
  std::vector<StageSeconds> stages;  // in the order they ran, without those of prepare_view
  Completion completion = Completion::Complete;
};

// Returns all objects in one prepared view, best probability first. Its camera_from_world matters
// only to a prior in the world (DetectOptions::scan.world). `trace`, where given, receives what
// every stage held (detect/explain.h).
Detections detect_objects(const ObjectView& prepared, std::span<const TemplateSet> sets,
                          Backend& backend, const PipelineOptions& options,
                          DetectTrace* trace = nullptr);

// Returns all objects in several prepared, calibrated views of one static scene. It finds
// candidates in every view and refines each over all views (Eq. 11).
Detections detect_jointly(std::span<const ObjectView> prepared, std::span<const TemplateSet> sets,
                          Backend& backend, const PipelineOptions& options);

}  // namespace edgescout
