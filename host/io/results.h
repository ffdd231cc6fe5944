// Reads and writes the program's own result file: the objects found in one image, as JSON.
//
// A pose is `{"R": 9 numbers by row, "t": 3 in metres, "quaternion_wxyz": 4}`. A covariance is 36
// numbers by row, in the tangent of core/se3.h.
//
// Public header.
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

// What a result depends on apart from its image, by name: checksums of models, numbers of the
// camera, options.
using Settings = std::vector<std::pair<std::string, std::string>>;

struct ImageResult {
  std::filesystem::path image;
  int scene_id = 0;
  int image_id = 0;
  std::string camera_name;  // of a BOP scene with several cameras; else empty
  Camera camera;
  std::string device;                // Backend::name()
  Settings settings;                 // empty: unknown; sorted by name after reading
  std::string incomplete;            // why poses may be missing or not refined; empty: they are all
  std::vector<StageSeconds> stages;  // in the order in which they ran
  std::optional<Se3> camera_from_world;  // absent: the world is the camera frame
  std::vector<ObjectName> objects;       // Detection::object is an index into them
  std::vector<Detection> detections;
};

// Writes a result file, atomically. A number that is not finite becomes null. The fields:
//   edgescout_result   version of the format: 3
//   image, scene_id, image_id, device, camera
//   camera_name        only of a BOP scene with several cameras
//   incomplete         "deadline passed" or "cancelled"; only where the work was cut short
//   settings           {name: text}, optional
//   world              the frame of the poses: "scene" or "camera"
//   camera_from_world  only if `world` is "scene"
//   timings_ms         [{stage, ms}]
//   objects            [{id, name}]
//   detections         [{object_id, object, probability, psi, cost_px, matched_fraction,
//                      psi_z_score, unexplained_grey, convergence, world_from_object,
//                      camera_from_object, covariance}]
void save_image_result(const ImageResult& result, const std::filesystem::path& file);

// Reads the versions 2 and 3 of the format. In version 2 the field psi_z_score is named `evidence`.
// InputError naming file and field: the file is missing, is no JSON or has another version; a field
// is missing or of another type.
ImageResult load_image_result(const std::filesystem::path& file);

// Returns whether the file is a result of any version.
bool is_image_result(const std::filesystem::path& file);

}  // namespace edgescout
