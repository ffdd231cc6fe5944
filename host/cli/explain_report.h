// Writes what is known of lost poses: as a table of stages, as a summary of many poses, as JSON.
#pragma once

#include <nlohmann/json.hpp>
#include <span>
#include <string>

#include "host/cli/inputs.h"
#include "host/detect/explain.h"

namespace edgescout {

struct ExplainedPose {
  std::filesystem::path image;
  int scene_id = 0, image_id = 0;
  int object_id = 1;
  ObjectPose given;     // in the camera frame
  std::string picture;  // name of its file; empty: none
  LossReport report;
};

// One line per stage: whether it held the pose, and its numbers.
std::string stage_table(const ExplainedPose& pose);

// One line: the image, the object, the stage that lost the pose, and the numbers of that stage.
std::string one_line(const ExplainedPose& pose);

// One row per object, and one for all: how many of the poses each stage lost.
std::string summary_table(std::span<const ExplainedPose> poses);

// The format is that of docs/results.md.
nlohmann::ordered_json json_of(std::span<const ExplainedPose> poses, const SamePoseOptions& same);

}  // namespace edgescout
