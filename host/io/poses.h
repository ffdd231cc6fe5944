// Reads poses from which a registration starts, whatever program made them.
//
// Four formats are read: a BOP results CSV (.csv), a result of this program (results.h), BOP's
// scene_gt.json, and a JSON list
//   [{"image": 12 or "000012.png", "object": 1, "R": 9 numbers or 3 rows, "t": 3 in metres,
//     "scene": 48 (optional), "camera": "cam1" (optional), "score": 0.7 (optional)}, ...]
// where R and t map the object frame to the camera frame.
//
// Public header.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "host/core/se3.h"

namespace edgescout {

struct StartPose {
  std::optional<int> scene_id;  // absent: fits any scene
  int image_id = 0;
  // As written in the file. If not empty, it names the image in place of image_id.
  std::filesystem::path image;
  std::string camera_name;  // of a scene with several cameras; empty: fits every camera
  int object_id = 1;
  Se3 camera_from_object;
  double score = 0;  // as written; registration does not use it
};

// Reads start poses: a CSV file of results, a result file, or a list. InputError naming file, line
// or field.
std::vector<StartPose> load_start_poses(const std::filesystem::path& file);

struct PosedImage {
  std::filesystem::path file;
  std::optional<int> scene_id;  // absent: fits any scene
  int image_id = 0;
  std::string camera_name;  // of a scene with several cameras
};

// Returns whether the pose may belong to this image. Images are compared by their file names, since
// folders may have moved. A pose or an image without a scene fits every scene.
bool belongs_to(const StartPose& pose, const PosedImage& image);
// Counts the names that the ends of both paths have in common: the file's name, its folder's and so
// on. If several images have one file name, the pose belongs to the image with the highest count.
int same_ending(const StartPose& pose, const std::filesystem::path& image);

}  // namespace edgescout
