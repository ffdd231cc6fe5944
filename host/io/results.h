// What is found in one image, as JSON: the tool's own result file.
//
// Poses are `{"R": 9 numbers by row, "t": 3 in metres, "quaternion_wxyz": 4}`; covariances 36
// numbers by row in the tangent of core/se3.h.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "host/core/stopwatch.h"
#include "host/core/types.h"

namespace edgescout {

struct ObjectName {
  int id = 1;  // BOP obj_id
  std::string name;
};

// What a result was made with beside its image, by name: checksums of models, numbers of the
// camera, options.
using Settings = std::vector<std::pair<std::string, std::string>>;

struct ImageResult {
  std::filesystem::path image;
  int scene_id = 0;
  int image_id = 0;
  Camera camera;
  std::string device;                    // Backend::name()
  Settings settings;                     // empty: not told; by name once read
  std::vector<StageSeconds> stages;      // in the order they ran
  std::optional<Se3> camera_from_world;  // where absent, the world is the camera frame
  std::vector<ObjectName> objects;       // what Detection::object indexes
  std::vector<Detection> detections;
};

// Atomically. The fields: edgescout_result (version of the format, 2), image, scene_id, image_id,
// device, camera, settings {name: text} (optional), world (whose frame it is, for who reads the
// file: "scene" or "camera"), camera_from_world (of a scene), timings_ms [{stage, ms}], objects
// [{id, name}], detections [{object_id, object, world_from_object, camera_from_object, covariance,
// probability, psi, cost_px, matched_fraction, evidence, unexplained_grey, convergence}]. A number
// that is not finite becomes null.
void save_image_result(const ImageResult& result, const std::filesystem::path& file);

// InputError naming file and field: missing, no JSON, another version, a field missing or of
// another type.
ImageResult load_image_result(const std::filesystem::path& file);

// Whether the file holds the fields of a result (of any version).
bool is_image_result(const std::filesystem::path& file);

}  // namespace edgescout
