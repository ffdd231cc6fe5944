// Reads BOP's lists of what to estimate: test_targets_bop19.json, test_targets_bop24.json and
// test_targets_multiview_bop25.json.
//
// Public header.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace edgescout {

struct BopView {
  std::string camera_name;  // empty: every camera
  int image_id = 0;
};

// One entry. The list of 2019 has one for each object of an image, that of 2024 one for each image,
// that of 2025 one for each group of images that are worked on together.
struct BopTarget {
  int scene_id = 0;
  std::vector<BopView> views;    // im_id: a number, numbers, or pairs of camera and number
  std::optional<int> object_id;  // obj_id
  std::optional<int> instances;  // inst_count
  bool is_group = false;         // im_id is a list
};

// Reads BOP's list of targets, of any of the three forms. InputError naming file and field.
std::vector<BopTarget> load_bop_targets(const std::filesystem::path& file);

}  // namespace edgescout
