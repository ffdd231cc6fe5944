// edgescout eval: the truth scores 1, a known mistake scores what a hand works out.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "host/io/depth_png.h"
#include "host/io/image.h"
#include "tests/cli/example_scene.h"

namespace edgescout::test {
namespace {

std::vector<std::string> eval_of(const fs::path& results, const fs::path& scenes,
                                 const std::vector<std::string>& more = {}) {
  return joined({{"eval", results, scenes}, part_models(), models_info(), more});
}

std::vector<BopResult> truth_of_both_scenes() {
  std::vector<BopResult> all;
  for (const fs::path& folder : {one_view(), two_views()}) {
    const BopScene scene = load_bop_scene(folder);
    for (const BopImage& image : scene.images)
      for (const BopResult& result : true_results(scene, image.image_id)) all.push_back(result);
  }
  return all;
}

struct Evaluated {
  Outcome outcome;
  nlohmann::json figures;
};

Evaluated evaluate_rows(const std::vector<BopResult>& rows, const fs::path& scenes,
                        const std::vector<std::string>& more = {}) {
  const TemporaryFolder folder;
  save_bop_results(rows, folder.path() / "r.csv");
  const fs::path json = folder.path() / "new/r.json";
  Evaluated evaluated{
      run_program(eval_of(folder.path() / "r.csv", scenes, joined({{"--json", json}, more}))), {}};
  EXPECT_EQ(evaluated.outcome.exit_code, 0) << evaluated.outcome.err;
  evaluated.figures = nlohmann::json::parse(content_of(json));
  return evaluated;
}

TEST(Eval, OfTheTruthIsOne) {
  const Evaluated evaluated = evaluate_rows(truth_of_both_scenes(), examples() / "scenes");
  const auto& all = evaluated.figures.at("all");
  EXPECT_EQ(all.at("images"), 3);
  EXPECT_EQ(all.at("truths"), 24);
  EXPECT_EQ(all.at("estimates"), 24);
  for (const char* figure : {"ar_mssd_mspd", "ar_mssd", "ar_mspd", "recall_pose_raw",
                             "recall_pose_symmetric", "recall_mspd_below_max"})
    EXPECT_NEAR(all.at(figure).get<double>(), 1, 1e-12) << figure;
  EXPECT_EQ(all.at("false_positives"), 0);
  EXPECT_EQ(evaluated.figures.at("objects").size(), 6u);
  EXPECT_NE(evaluated.outcome.out.find("all"), std::string::npos);
  EXPECT_EQ(evaluated.outcome.out.find("left out"), std::string::npos) << evaluated.outcome.out;
  EXPECT_EQ(evaluated.outcome.out.find("no symmetries"), std::string::npos)
      << evaluated.outcome.out;
}

TEST(Eval, CountsRowsWithoutPose) {
  const TemporaryFolder folder;
  save_bop_results(true_results(load_bop_scene(one_view()), 0), folder.path() / "r.csv");
  const std::string rows = content_of(folder.path() / "r.csv") + "48,0,2,0.1,,,0.1\n";
  const fs::path json = folder.path() / "r.json";
  const Outcome outcome = run_program({"eval", folder.write("r.csv", rows), one_view(), "--model",
                                       part_file(2), "--unit", "mm", "--json", json});
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_EQ(nlohmann::json::parse(content_of(json)).at("rows_without_pose"), 1);
  expect_refused(
      {"eval", folder.write("empty.csv", ""), one_view(), "--model", part_file(2), "--unit", "mm"},
      {"empty.csv", "nothing", "scene_id"});
}

// As BOP's own subsets are evaluated. Other objects in the scenes and results are neither misses
// nor false positives.
TEST(Eval, EvaluatesTheObjectsWhoseModelsAreGiven) {
  const TemporaryFolder folder;
  std::vector<BopResult> rows = true_results(load_bop_scene(one_view()), 0);
  const auto of_object_2 = std::ranges::count(rows, 2, &BopResult::object_id);
  ASSERT_GT(of_object_2, 0);
  for (BopResult& row : rows)
    if (row.object_id != 2) row.camera_from_object.translation_m.z() -= 0.2;  // misses
  save_bop_results(rows, folder.path() / "r.csv");
  const fs::path json = folder.path() / "r.json";
  const Outcome outcome = run_program({"eval", folder.path() / "r.csv", one_view(), "--model",
                                       part_file(2), "--unit", "mm", "--json", json});
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  const auto figures = nlohmann::json::parse(content_of(json));
  EXPECT_EQ(figures.at("all").at("truths"), of_object_2);
  EXPECT_EQ(figures.at("all").at("estimates"), of_object_2);
  EXPECT_EQ(figures.at("all").at("recall_pose_raw"), 1.0);
  EXPECT_EQ(figures.at("all").at("false_positives"), 0);
  EXPECT_EQ(figures.at("objects").size(), 1u);
  std::set<int> others;
  for (const BopResult& row : rows)
    if (row.object_id != 2) others.insert(row.object_id);
  EXPECT_EQ(figures.at("objects_left_out").get<std::set<int>>(), others);
  for (const char* words :
       {"left out, truths and estimates", "no symmetries without --models-info"})
    EXPECT_NE(outcome.out.find(words), std::string::npos) << outcome.out;
  expect_refused({"eval", folder.path() / "r.csv", one_view(), "--model", part_file(2), "--unit",
                  "mm", "--object-id", "77"},
                 {"--model", "none of the scenes' objects", "--object-id"});
}

// Scene 0 holds 8 parts. Of their poses one comes 200 mm nearer to the camera: a miss by every
// measure and a false positive. Another moves 4 mm sideways: within the paper's bound, and beyond
// the smallest of BOP's.
TEST(Eval, OfKnownMistakesIsWhatAHandWorksOut) {
  const BopScene scene = load_bop_scene(one_view());
  std::vector<BopResult> rows = true_results(scene, 0);
  ASSERT_EQ(rows.size(), 8u);
  rows[0].camera_from_object.translation_m.z() -= 0.2;
  rows[3].camera_from_object.translation_m.x() += 0.004;
  const Mesh bracket = load_mesh(part_file(1), LengthUnit::Millimetre);
  ASSERT_EQ(rows[3].object_id, 1);  // the L-bracket has no symmetries: its MSSD is 4 mm
  const auto all = evaluate_rows(rows, one_view()).figures.at("all");
  EXPECT_DOUBLE_EQ(all.at("recall_pose_raw").get<double>(), 7.0 / 8);
  EXPECT_DOUBLE_EQ(all.at("recall_pose_symmetric").get<double>(), 7.0 / 8);
  int passed = 0;  // of the ten thresholds, 5 to 50 % of the diameter
  for (int step = 1; step <= 10; ++step) passed += 0.004 < 0.05 * step * bracket.diameter_m;
  ASSERT_EQ(passed, 9);  // 4 mm of 74.86 mm are more than 5 % and less than 10 %
  EXPECT_NEAR(all.at("ar_mssd").get<double>(), (6 + passed / 10.0) / 8, 1e-12);
  EXPECT_EQ(all.at("false_positives"), 1);
  EXPECT_DOUBLE_EQ(all.at("false_positives_per_image").get<double>(), 1);
}

// The example's scene gets depth: a wall behind all parts, so that nothing hides them.
TEST(Eval, HasVsdWhereAllImagesHaveDepth) {
  const TemporaryFolder folder;
  const fs::path scene = folder.path() / "000000";
  fs::copy(one_view(), scene, fs::copy_options::recursive);
  fs::create_directory(scene / "depth");
  const Image grey = load_image(scene / "gray/000000.png");
  write_depth_png({grey.width, grey.height, std::vector<float>(grey.pixels.size(), 5.0f)}, 1e-3,
                  scene / "depth/000000.png");
  std::vector<BopResult> rows = true_results(load_bop_scene(scene), 0);
  rows[0].camera_from_object.translation_m.x() += 0.5;  // a miss
  const Evaluated with = evaluate_rows(rows, scene);
  const auto all = with.figures.at("all");
  EXPECT_NEAR(all.at("ar_vsd").get<double>(), 7.0 / 8, 1e-12);
  EXPECT_NEAR(all.at("ar").get<double>(), 7.0 / 8, 1e-12);
  EXPECT_EQ(with.outcome.out.find("no VSD"), std::string::npos) << with.outcome.out;
  const Evaluated off = evaluate_rows(rows, scene, {"--no-vsd"});
  EXPECT_TRUE(off.figures.at("all").at("ar").is_null());
  const Evaluated without = evaluate_rows(rows, one_view());
  EXPECT_TRUE(without.figures.at("all").at("ar_vsd").is_null());
  EXPECT_NE(without.outcome.out.find("no VSD: 1 of 1 images have no depth image"),
            std::string::npos)
      << without.outcome.out;
}

TEST(Eval, DropsWhatIsHardlyVisibleOrUnlikely) {
  const BopScene scene = load_bop_scene(one_view());
  std::vector<BopResult> rows = true_results(scene, 0);
  rows[0].score = 0.2;  // a fully visible nut
  const auto all = evaluate_rows(rows, one_view(), {"--min-score", "0.5", "--min-visible", "0.9"})
                       .figures.at("all");
  EXPECT_EQ(all.at("truths"), 6);  // two are seen by 56 and 70 %
  EXPECT_EQ(all.at("estimates"), 7);
  EXPECT_DOUBLE_EQ(all.at("recall_pose_raw").get<double>(), 5.0 / 6);
  EXPECT_EQ(all.at("false_positives"), 0);
}

TEST(Eval, DropsNothingUnlessAsked) {
  std::vector<BopResult> rows = true_results(load_bop_scene(one_view()), 0);
  for (BopResult& row : rows) row.score = -2e6;  // a log-likelihood of another method
  const Evaluated evaluated = evaluate_rows(rows, one_view());
  EXPECT_EQ(evaluated.figures.at("all").at("estimates"), 8);
  EXPECT_TRUE(evaluated.figures.at("min_score").is_null());
  EXPECT_NE(evaluated.outcome.out.find("all estimates"), std::string::npos)
      << evaluated.outcome.out;
  EXPECT_EQ(evaluate_rows(rows, one_view(), {"--min-score", "0"}).figures.at("all").at("estimates"),
            0);
}

TEST(Eval, RefusesWhatItCannotEvaluate) {
  const TemporaryFolder folder;
  const BopResult good = truth_of_both_scenes()[0];
  const auto results = [&](const BopResult& row) {
    save_bop_results({row}, folder.path() / "r.csv");
    return folder.path() / "r.csv";
  };
  const fs::path json = folder.path() / "r.json";
  const std::vector<std::string> to_json{"--json", json};
  expect_refused(eval_of(folder.path() / "none.csv", one_view(), to_json), {"none.csv"});
  expect_refused(eval_of(folder.write("cut.csv", "0,0,1,0.5,1 0 0"), one_view(), to_json),
                 {"cut.csv", "line 1"});
  BopResult row = good;
  row.image_id = 3;
  expect_refused(eval_of(results(row), one_view(), to_json), {"r.csv", "im_id", "3"});
  row = good;
  row.object_id = 12;
  expect_refused(eval_of(results(row), one_view(), to_json), {"r.csv", "obj_id", "12"});
  expect_refused(eval_of(results(good), folder.path(), to_json), {"scene_camera.json"});
  expect_refused(eval_of(results(good), one_view(), joined({to_json, {"--min-visible", "2"}})),
                 {"--min-visible", "found 2", "0 to 1"});
  fs::create_directory(folder.path() / "000000");
  fs::copy(one_view() / "scene_camera.json", folder.path() / "000000");
  expect_refused(eval_of(results(good), folder.path() / "000000", to_json), {"scene_gt.json"});
  EXPECT_FALSE(fs::exists(json));
  expect_refused(eval_of(results(good), one_view(), {"--json", "/proc/r.json"}), {"/proc: "});
}

}  // namespace
}  // namespace edgescout::test
