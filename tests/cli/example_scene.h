// The two rendered scenes of docs/examples, their parts, and bad requests.
#pragma once

#include <gtest/gtest.h>

#include <initializer_list>

#include "host/core/random.h"
#include "host/io/bop.h"
#include "host/io/mesh.h"
#include "tests/cli/program.h"
#include "tests/examples.h"

namespace edgescout::test {

namespace fs = std::filesystem;

inline fs::path one_view() { return examples() / "scenes/000000"; }
inline fs::path two_views() { return examples() / "scenes/000001"; }
inline std::string part_file(int id) {
  return examples() / ("parts/obj_00000" + std::to_string(id) + ".ply");
}

// --model of all six parts, with their unit.
inline std::vector<std::string> part_models() {
  std::vector<std::string> arguments{"--unit", "mm", "--model"};
  for (int id = 1; id <= 6; ++id) arguments.push_back(part_file(id));
  return arguments;
}
inline std::vector<std::string> models_info() {
  return {"--models-info", examples() / "parts/models_info.json"};
}

inline std::vector<std::string> joined(std::initializer_list<std::vector<std::string>> parts) {
  std::vector<std::string> all;
  for (const auto& part : parts) all.insert(all.end(), part.begin(), part.end());
  return all;
}

// The true poses of one image as results, those seen by at least `min_visible`.
inline std::vector<BopResult> true_results(const BopScene& scene, int image_id,
                                           double min_visible = 0) {
  std::vector<BopResult> results;
  for (const BopTruth& truth : scene.truth.at(image_id))
    if (truth.visible_fraction >= min_visible)
      results.push_back(
          {scene.scene_id, image_id, truth.object_id, 1, truth.camera_from_object, -1, ""});
  return results;
}

// The same results turned by `angle_rad` and moved by `distance_m` in random directions.
inline std::vector<BopResult> perturbed(std::vector<BopResult> results, double angle_rad,
                                        double distance_m, Random random) {
  for (BopResult& result : results) {
    Vector6d delta;
    delta.head<3>() = distance_m * random.direction();
    delta.tail<3>() = angle_rad * random.direction();
    result.camera_from_object = retract(result.camera_from_object, delta);
  }
  return results;
}

// Exit code 2, one line that holds the words, nothing on standard output.
inline void expect_refused(const std::vector<std::string>& arguments,
                           std::initializer_list<std::string> words,
                           const std::string& environment = "") {
  const Outcome outcome = run_program(arguments, environment);
  EXPECT_EQ(outcome.exit_code, 2) << outcome.err;
  EXPECT_EQ(outcome.out, "");
  EXPECT_TRUE(is_one_line_error(outcome.err)) << outcome.err;
  for (const std::string& word : words)
    EXPECT_NE(outcome.err.find(word), std::string::npos) << word << " not in " << outcome.err;
}

}  // namespace edgescout::test
