// What the library keeps under each kind of handle.
#pragma once

#include <atomic>
#include <memory>
#include <string>
#include <variant>
#include <vector>

#include "host/bindings/c/src/handles.h"
#include "host/bindings/c/src/option_set.h"
#include "host/io/image.h"
#include "host/pipeline.h"
#include "kernels/backend.h"

namespace edgescout::c {

// Of one part or several; detection looks for all of them.
struct PartTemplates {
  std::vector<TemplateSet> sets;
  std::vector<EdgeModel> models;  // of the sets
};

struct FoundObject : Detection {
  int object_id = 1;
  std::string name;
  std::vector<int> supporting_images;
};

struct FoundObjects {
  std::vector<FoundObject> found;
  Completion completion = Completion::Complete;
  std::vector<StageSeconds> stages;
};

struct NamedBackend {
  std::unique_ptr<Backend> backend;
  std::string name;
};

class SteppedScout;      // scout.cpp
class FollowingTracker;  // tracker.cpp

template <typename T>
struct Keeps {
  using Type = T;
};

template <>
struct Content<edgescout_canceller> : Keeps<std::unique_ptr<std::atomic<bool>>> {
  static constexpr const char* name = "canceller";
};
template <>
struct Content<edgescout_options> : Keeps<std::unique_ptr<OptionSet>> {
  static constexpr const char* name = "options";
};
template <>
struct Content<edgescout_backend> : Keeps<NamedBackend> {
  static constexpr const char* name = "backend";
};
template <>
struct Content<edgescout_camera> : Keeps<Camera> {
  static constexpr const char* name = "camera";
};
template <>
struct Content<edgescout_picture> : Keeps<std::variant<Image, RgbImage>> {
  static constexpr const char* name = "picture";
};
template <>
struct Content<edgescout_mesh> : Keeps<Mesh> {
  static constexpr const char* name = "mesh";
};
template <>
struct Content<edgescout_templates> : Keeps<PartTemplates> {
  static constexpr const char* name = "templates";
};
template <>
struct Content<edgescout_detections> : Keeps<FoundObjects> {
  static constexpr const char* name = "detections";
};
template <>
struct Content<edgescout_tracker> : Keeps<std::shared_ptr<FollowingTracker>> {
  static constexpr const char* name = "tracker";
};
template <>
struct Content<edgescout_scout> : Keeps<std::shared_ptr<SteppedScout>> {
  static constexpr const char* name = "scout";
};

}  // namespace edgescout::c
