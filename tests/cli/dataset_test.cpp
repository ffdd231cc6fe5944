// The verbs on datasets in the layouts of BOP's sets: several cameras, splits, targets.
#include "host/io/results.h"
#include "tests/cli/small_dataset.h"

namespace edgescout::test {
namespace {

constexpr double near_truth_m = 0.006;  // of one small view

std::vector<std::string> names_in(const fs::path& folder) {
  std::vector<std::string> names;
  for (const auto& entry : fs::directory_iterator(folder))
    names.push_back(entry.path().filename().string());
  std::ranges::sort(names);
  return names;
}

void expect_done(const Outcome& outcome) { EXPECT_EQ(outcome.exit_code, 0) << outcome.err; }

TEST(Dataset, OfSeveralCamerasIsSearchedInEach) {
  const SmallDataset set = industrial_set();
  expect_done(run_program(set.detect(set.scene, set.model())));
  EXPECT_EQ(names_in(set.out),
            (std::vector<std::string>{"000003_000000_cam1.json", "000003_000000_cam2.json",
                                      "report.html", "results.csv", "results_cam1.csv",
                                      "results_cam2.csv", "summary.json"}));
  const std::vector<BopResult> rows = load_bop_results(set.out / "results.csv");
  for (const char* camera : {"cam1", "cam2"}) {
    const BopScene scene = load_bop_scene(set.scene, camera);
    EXPECT_LT(off_truth_m(rows, scene, 0), near_truth_m) << camera;
    const fs::path own = set.out / ("results_" + std::string(camera) + ".csv");
    EXPECT_TRUE(content_of(own).starts_with("scene_id,im_id,obj_id,score,R,t,time\n"));
    EXPECT_LT(off_truth_m(load_bop_results(own), scene, 0), near_truth_m) << camera;
    const ImageResult result =
        load_image_result(set.out / ("000003_000000_" + std::string(camera) + ".json"));
    EXPECT_EQ(result.camera_name, camera);
  }
  for (const BopResult& row : rows)
    EXPECT_TRUE(row.camera_name == "cam1" || row.camera_name == "cam2") << row.camera_name;
}

TEST(Dataset, OfSeveralCamerasIsSearchedInChosenOnes) {
  const SmallDataset set = industrial_set();
  expect_done(run_program(set.detect(set.scene, joined({set.model(), {"--cameras", "cam2"}}))));
  EXPECT_EQ(names_in(set.out),
            (std::vector<std::string>{"000003_000000_cam2.json", "report.html", "results.csv",
                                      "results_cam2.csv", "summary.json"}));
  expect_refused(set.detect(set.scene, joined({set.model(), {"--cameras", "cam9"}})),
                 {"cam1, cam2", "--cameras", "cam9"});
}

TEST(Dataset, OfSeveralCamerasIsSearchedJointly) {
  const SmallDataset set = industrial_set();
  expect_done(run_program(set.detect(set.scene, joined({set.model(), {"--joint"}}))));
  const ImageResult first = load_image_result(set.out / "000003_000000_cam1.json"),
                    second = load_image_result(set.out / "000003_000000_cam2.json");
  ASSERT_GE(first.detections.size(), 1u);
  ASSERT_EQ(first.detections.size(), second.detections.size());
  EXPECT_LT(distance_between_m(first.detections[0].world_from_object,
                               second.detections[0].world_from_object),
            1e-12);
  const std::vector<BopResult> rows = load_bop_results(set.out / "results.csv");
  for (const char* camera : {"cam1", "cam2"})
    EXPECT_LT(off_truth_m(rows, load_bop_scene(set.scene, camera), 0), 0.002) << camera;
}

// The truth as results: of both cameras, and of one in BOP's own format.
TEST(Dataset, OfSeveralCamerasIsEvaluatedForEach) {
  const SmallDataset set = industrial_set();
  std::vector<BopResult> rows;
  for (const char* camera : {"cam1", "cam2"})
    for (BopResult row : true_results(load_bop_scene(set.scene, camera), 0)) {
      row.camera_name = camera;
      rows.push_back(row);
    }
  const fs::path csv = set.made.folder.path() / "r.csv", json = set.made.folder.path() / "r.json";
  const auto evaluate = [&](const std::vector<std::string>& more) {
    expect_done(run_program(joined({{"eval", csv, set.scene, "--json", json}, set.model(), more})));
    return nlohmann::json::parse(content_of(json)).at("all");
  };
  save_bop_results(rows, csv);
  EXPECT_EQ(evaluate({}).at("images"), 2);
  EXPECT_DOUBLE_EQ(evaluate({}).at("ap_mssd_mspd").get<double>(), 1);
  EXPECT_EQ(evaluate({"--cameras", "cam2"}).at("truths"), 1);
  std::swap(rows[0].camera_name, rows[1].camera_name);
  save_bop_results(rows, csv);
  EXPECT_LT(evaluate({}).at("ar_mssd").get<double>(), 0.5);
  rows = true_results(load_bop_scene(set.scene, "cam2"), 0);
  save_bop_results(rows, csv);
  expect_refused(joined({{"eval", csv, set.scene}, set.model()}),
                 {"r.csv", "camera", "--cameras", "cam1, cam2"});
  EXPECT_DOUBLE_EQ(evaluate({"--cameras", "cam2"}).at("ar_mssd").get<double>(), 1);
}

TEST(Dataset, OfSeveralCamerasIsRegisteredAndExplained) {
  const SmallDataset set = industrial_set();
  std::vector<BopResult> starts;
  for (const char* camera : {"cam1", "cam2"})
    for (BopResult row : true_results(load_bop_scene(set.scene, camera), 0)) {
      row.camera_name = camera;
      row.camera_from_object.translation_m.x() += 0.002;
      starts.push_back(row);
    }
  const fs::path csv = set.made.folder.path() / "starts.csv";
  save_bop_results(starts, csv);
  expect_done(run_program(joined({{"register", set.scene, "--poses", csv, "--out", set.out,
                                   "--device", "cpu", "--no-overlays"},
                                  set.model()})));
  const std::vector<BopResult> rows = load_bop_results(set.out / "results.csv");
  ASSERT_EQ(rows.size(), 2u);
  for (const char* camera : {"cam1", "cam2"})
    EXPECT_LT(off_truth_m(rows, load_bop_scene(set.scene, camera), 0), near_truth_m) << camera;
  const Outcome outcome = run_program(
      joined({{"explain", set.scene, "--truth", "--device", "cpu"}, set.model(), few_templates()}));
  expect_done(outcome);
  for (const char* file : {"rgb_cam1", "gray_cam2"})
    EXPECT_NE(outcome.out.find(file), std::string::npos) << outcome.out;
}

TEST(Dataset, IsTakenFromItsRootWithItsModels) {
  const SmallDataset set(Views{{"", "gray"}}, "test_primesense", "models_cad");
  expect_refused(set.detect(set.root), {"test_primesense", "--split"});
  expect_refused(set.detect(set.root, {"--split", "val"}), {"--split", "val", "test_primesense"});
  expect_done(run_program(set.detect(set.root, {"--split", "test"})));
  const std::vector<BopResult> rows = load_bop_results(set.out / "results.csv");
  EXPECT_LT(off_truth_m(rows, load_bop_scene(set.scene), 0), near_truth_m);
  const Outcome outcome =
      run_program({"eval", set.out / "results.csv", set.root, "--split", "test"});
  expect_done(outcome);
  EXPECT_EQ(outcome.out.find("no symmetries"), std::string::npos) << outcome.out;
  expect_refused(set.detect(set.root, {"--split", "test", "--object-id", "7"}),
                 {"--object-id", "7", "models_cad"});
}

// Two images; the list of 2024 names one, that of 2019 another object.
TEST(Dataset, IsRestrictedToTargets) {
  const SmallDataset set(Views{{"", "gray"}, {"", "gray", ".bmp"}});
  const TemporaryFolder& folder = set.made.folder;
  const fs::path of_2024 = folder.write("t24.json", R"([{"scene_id": 3, "im_id": 1}])");
  const auto detect = [&](const fs::path& targets) {
    return set.detect(set.root, {"--split", "test", "--targets", targets});
  };
  expect_done(run_program(detect(of_2024)));
  EXPECT_EQ(names_in(set.out), (std::vector<std::string>{"000003_000001.json", "report.html",
                                                         "results.csv", "summary.json"}));
  std::vector<BopResult> rows = true_results(load_bop_scene(set.scene), 1);
  save_bop_results(rows, folder.path() / "r.csv");
  const fs::path json = folder.path() / "r.json";
  expect_done(run_program({"eval", folder.path() / "r.csv", set.root, "--split", "test",
                           "--targets", of_2024, "--json", json}));
  EXPECT_EQ(nlohmann::json::parse(content_of(json)).at("all").at("images"), 1);
  EXPECT_NEAR(nlohmann::json::parse(content_of(json)).at("all").at("ar_mssd").get<double>(), 1,
              1e-12);
  expect_refused(detect(folder.write("no.json", R"([{"scene_id": 3, "im_id": 5}])")),
                 {"no.json", "scene 3", "image 5"});
  expect_refused(detect(folder.write("no.json", R"([{"scene_id": 4, "im_id": 0}])")),
                 {"no.json", "none in the scenes"});
}

TEST(Dataset, ReportsAsManyInstancesAsTheTargetsSay) {
  const SmallDataset set(Views{{"", "gray"}, {"", "gray"}});
  const fs::path targets = set.made.folder.write(
      "t19.json", R"([{"scene_id": 3, "im_id": 0, "obj_id": 1, "inst_count": 1},
                      {"scene_id": 3, "im_id": 1, "obj_id": 1, "inst_count": 0}])");
  expect_done(run_program(set.detect(set.root, {"--split", "test", "--targets", targets})));
  std::vector<int> images;
  for (const BopResult& row : load_bop_results(set.out / "results.csv"))
    images.push_back(row.image_id);
  EXPECT_EQ(images, std::vector<int>{0});
}

TEST(Dataset, WarnsOfTargetsWithoutAModel) {
  const SmallDataset set(Views{{"", "gray"}, {"", "gray"}});
  const fs::path targets = set.made.folder.write(
      "t19.json", R"([{"scene_id": 3, "im_id": 0, "obj_id": 1, "inst_count": 1},
                      {"scene_id": 3, "im_id": 0, "obj_id": 7, "inst_count": 2},
                      {"scene_id": 3, "im_id": 1, "obj_id": 9, "inst_count": 1},
                      {"scene_id": 3, "im_id": 1, "obj_id": 7, "inst_count": 1}])");
  const Outcome outcome = run_program(
      set.detect(set.root, joined({{"--split", "test", "--targets", targets}, set.model()})));
  expect_done(outcome);
  EXPECT_NE(outcome.err.find("t19.json: obj_id: found 7, 9, expected objects with a model: 3 of 4 "
                             "targets are not searched for"),
            std::string::npos)
      << outcome.err;
}

// The groups of 2025 are worked on by themselves.
TEST(Dataset, IsSearchedJointlyInTheGroupsOfTargets) {
  const SmallDataset set(Views{{"cam1", "rgb_cam1"}, {"cam1", "rgb_cam1"}, {"cam2", "rgb_cam2"}});
  const fs::path targets = set.made.folder.write(
      "t25.json",
      R"([{"scene_id": 3, "im_id": [["cam1", 0], ["cam2", 0]]}, {"scene_id": 3, "im_id": [["cam1", 1]]}])");
  expect_done(
      run_program(set.detect(set.root, {"--split", "test", "--targets", targets, "--joint"})));
  const auto views = [&](const char* name) {
    const ImageResult result = load_image_result(set.out / name);
    return std::ranges::find(result.settings, "views", &Settings::value_type::first)->second;
  };
  EXPECT_TRUE(views("000003_000000_cam1.json").starts_with("2 jointly"));
  EXPECT_TRUE(views("000003_000000_cam2.json").starts_with("2 jointly"));
  EXPECT_TRUE(views("000003_000001_cam1.json").starts_with("1 jointly"));
}

TEST(Dataset, IsSearchedWithoutItsTruth) {
  const SmallDataset set(Views{{"", "gray"}});
  std::ofstream(set.scene / "scene_gt_info.json") << R"({"0": [{"visib_fract": null}]})";
  expect_done(run_program(set.detect(set.scene, set.model())));
  expect_refused(joined({{"eval", set.out / "results.csv", set.scene}, set.model()}),
                 {"scene_gt_info.json", "/0/0/visib_fract", "null", "a number"});
  std::ofstream(set.scene / "scene_gt.json") << "[";
  expect_done(run_program(set.detect(set.scene, joined({set.model(), {"--resume"}}))));
}

}  // namespace
}  // namespace edgescout::test
