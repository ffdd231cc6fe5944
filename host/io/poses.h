// Poses to start a registration from, of any origin.
//
// Three forms: a BOP results CSV (.csv); a result of this tool (results.h); or a JSON list
//   [{"image": 12 or "000012.png", "object": 1, "R": 9 numbers by row, "t": 3 in metres, "scene":
//   48 (optional), "score": 0.7 (optional)}, ...]
// where R and t map the object frame to the camera frame.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "host/core/se3.h"

namespace edgescout {

struct StartPose {
  std::optional<int> scene_id;  // absent: of any scene
  int image_id = 0;
  std::filesystem::path
      image;  // as written; where not empty, it names the image instead of image_id
  int object_id = 1;
  Se3 camera_from_object;
  double score = 0;  // as written; registration does not ask for it
};

// InputError naming file, line or field.
std::vector<StartPose> load_start_poses(const std::filesystem::path& file);

// Whether the pose may be meant for this image. Images are compared by their file names: folders
// may have moved since. No scene on either side fits every scene.
bool belongs_to(const StartPose& pose, const std::filesystem::path& image,
                std::optional<int> scene_id, int image_id);
// How many names at the ends of the pose's path and the image's are the same: the file's, its
// folder's and so on. Of several images of one file name the pose is meant for the one with the
// most.
int same_ending(const StartPose& pose, const std::filesystem::path& image);

}  // namespace edgescout
