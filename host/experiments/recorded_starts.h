// Reads the set d2co-starts: rendered images, starts at four distances from the truth, and the
// results of the original implementation's methods from these starts.
//
// Layout: ground_truth.json, starts.csv, cad/, images/, original_results/ (docs/evaluation.md).
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

// Returns the names of the images that have starts. InputError naming the first missing file of the
// set, or the row of a start whose level is not 1 to 4.
std::vector<std::string> recorded_images(const std::filesystem::path& folder);
// Loads the named image and `others` more of the same scene.
KnownScene recorded_scene(const std::filesystem::path& folder, const std::string& image,
                          int others);
// Returns how many more images of the same scene there are.
int other_views(const std::filesystem::path& folder, const std::string& image);
// Returns the starts of this image whose number is a multiple of `every`. The original methods ran
// on the multiples of 9 and 27.
std::vector<RecordedStart> recorded_starts(const std::filesystem::path& folder,
                                           const KnownScene& scene, int every);

// A pose at which another program's method ended, and whether its authors counted it as correct.
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
