// The set d2co-starts: rendered images, starts at four distances from the truth, and where the
// original implementation's methods ended from them. Layout: ground_truth.json, starts.csv, cad/,
// images/, original_results/ (docs/evaluation.md).
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "host/experiments/known_scene.h"
#include "host/experiments/table.h"

namespace edgescout {

struct RecordedStart {
  int id = 0;
  int instance = 0;  // index into the scene's instances
  int level = 1;     // 1: 0.1 rad and 5 mm from the truth, 2: 0.2 / 10, 3: 0.3 / 15, 4: 0.4 / 20
  Se3 camera_from_object;  // in the first image
};

// The images' names, those with starts alone. InputError naming the first file of the set that is
// missing, or the row of a start whose level is none of the four.
std::vector<std::string> recorded_images(const std::filesystem::path& folder);
// The named image, after it `others` more of the same scene (0 where it has none).
KnownScene recorded_scene(const std::filesystem::path& folder, const std::string& image,
                          int others);
int other_views(const std::filesystem::path& folder, const std::string& image);
// Those of this image whose number `every` divides: 9 and 27 are what the original methods ran on.
std::vector<RecordedStart> recorded_starts(const std::filesystem::path& folder,
                                           const KnownScene& scene, int every);

// A pose somebody's method ended at, and whether they counted it as right.
struct RecordedResult {
  int start = 0;
  std::string image, instance, method;
  int level = 1;
  Se3 camera_from_object;
  bool is_right = false;
  double cpu_ms = 0;
};
std::vector<RecordedResult> recorded_results(const std::filesystem::path& file);

}  // namespace edgescout
