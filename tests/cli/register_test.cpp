// edgescout register on the example scenes: poses come back to the truth, in every form that is
// written.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "host/core/pose_error.h"
#include "host/io/image.h"
#include "host/io/results.h"
#include "tests/cli/register_call.h"
#include "tests/test_random.h"

namespace edgescout::test {
namespace {

void expect_at_truth(const std::vector<BopResult>& found, const std::vector<BopResult>& truth,
                     double max_angle_rad) {
  const std::map<int, Symmetries> symmetries =
      load_symmetries(examples() / "parts/models_info.json", 2000);
  ASSERT_EQ(found.size(), truth.size());
  for (std::size_t i = 0; i < found.size(); ++i) {
    EXPECT_EQ(found[i].scene_id, truth[i].scene_id);
    EXPECT_EQ(found[i].image_id, truth[i].image_id);
    ASSERT_EQ(found[i].object_id, truth[i].object_id);
    const auto known = symmetries.find(found[i].object_id);
    const PoseError error = pose_error(found[i].camera_from_object, truth[i].camera_from_object,
                                       known == symmetries.end() ? Symmetries{} : known->second);
    EXPECT_LT(error.angle_rad, max_angle_rad) << "object " << found[i].object_id;
    EXPECT_LT(error.distance_m, 0.001) << "object " << found[i].object_id;
  }
}

// The parts whose pose one view of 640 px settles to a millimetre: the depth of the smaller and the
// more symmetric is less certain.
std::vector<BopResult> certain_truths(const BopScene& scene) {
  std::vector<BopResult> truths = true_results(scene, 0, 0.9);
  std::erase_if(truths, [](const BopResult& t) { return t.object_id != 2 && t.object_id != 5; });
  return truths;
}

TEST(Register, BringsPerturbedPosesBackToTheTruth) {
  const TemporaryFolder folder;
  const BopScene scene = load_bop_scene(one_view());
  const std::vector<BopResult> truth = certain_truths(scene);
  ASSERT_EQ(truth.size(), 2u);
  save_bop_results(perturbed(truth, 0.1, 0.005, test_random()), folder.path() / "starts.csv");
  const fs::path out = folder.path() / "out";
  const Outcome outcome = run_program(
      register_in(one_view(), folder.path() / "starts.csv", out, {"--log-level", "debug"}));
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  for (const char* words :
       {"debug: ", ": 2 poses, ", " ms, edges ", " ms, tensors ", " ms, registration "})
    EXPECT_NE(outcome.err.find(words), std::string::npos) << words << " not in " << outcome.err;
  const std::vector<BopResult> rows = load_bop_results(out / "results.csv");
  expect_at_truth(rows, truth, 0.01);
  const ImageResult result = load_image_result(out / "000000_000000.json");
  EXPECT_EQ(result.device, "cpu");
  EXPECT_EQ(result.camera.width, 640);
  ASSERT_EQ(result.detections.size(), rows.size());
  const Se3 camera_from_world = scene.images[0].camera_from_world.value();
  ASSERT_TRUE(result.camera_from_world.has_value());
  EXPECT_LT(distance_between_m(*result.camera_from_world, camera_from_world), 1e-9);
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const Se3 camera_from_object = camera_from_world * result.detections[i].world_from_object;
    EXPECT_LT(distance_between_m(camera_from_object, rows[i].camera_from_object), 1e-9);
    EXPECT_EQ(result.detections[i].probability, rows[i].score);
    EXPECT_GT(rows[i].score,
              0.1);  // small parts of soft contrast: the fit gives their right poses 0.2 to 0.5
    EXPECT_GT(rows[i].time_s, 0);
    EXPECT_TRUE(result.detections[i].covariance.allFinite());
  }
  EXPECT_EQ(load_image(out / "000000_000000_overlay.png").width, 640);
}

TEST(Register, GoesOnFromItsOwnResultAndFromAJsonList) {
  const TemporaryFolder folder;
  const BopScene scene = load_bop_scene(one_view());
  const std::vector<BopResult> truth{certain_truths(scene)[0]};
  const Eigen::Matrix3d r = truth[0].camera_from_object.rotation.toRotationMatrix();
  const Eigen::Vector3d t = truth[0].camera_from_object.translation_m;
  std::vector<double> rotation;
  for (int i = 0; i < 9; ++i) rotation.push_back(r(i / 3, i % 3));
  const nlohmann::json list{{{"image", "000000.png"},
                             {"object", truth[0].object_id},
                             {"R", rotation},
                             {"t", {t.x(), t.y(), t.z()}}}};
  const std::string poses = folder.write("poses.json", list.dump());
  const fs::path first = folder.path() / "first", second = folder.path() / "second";
  const std::vector<std::string> plain{"--search-rotation", "0", "--no-overlays"};
  ASSERT_EQ(run_program(register_in(one_view(), poses, first, plain)).exit_code, 0);
  expect_at_truth(load_bop_results(first / "results.csv"), truth, 0.01);
  EXPECT_FALSE(fs::exists(first / "000000_000000_overlay.png"));
  ASSERT_EQ(
      run_program(register_in(one_view(), first / "000000_000000.json", second, plain)).exit_code,
      0);
  expect_at_truth(load_bop_results(second / "results.csv"), truth, 0.01);
}

TEST(Register, RefinesOneWorldPoseOverAllViews) {
  const TemporaryFolder folder;
  const BopScene scene = load_bop_scene(two_views());
  const std::vector<BopResult> truth = true_results(scene, 1);
  save_bop_results(perturbed(truth, 0.1, 0.005, test_random()), folder.path() / "starts.csv");
  const fs::path out = folder.path() / "out";
  const Outcome outcome =
      run_program(register_in(two_views(), folder.path() / "starts.csv", out, {"--multi-view"}));
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  expect_at_truth(load_bop_results(out / "results.csv"), truth, 0.02);
  const ImageResult result = load_image_result(out / "000001_000001.json");
  ASSERT_TRUE(result.camera_from_world.has_value());
  // The starts were given in image 1; the pose holds in image 0 as well, where it is drawn.
  std::vector<BopResult> elsewhere;
  const Se3 other_from_world = *scene.images[0].camera_from_world;
  for (const Detection& d : result.detections)
    elsewhere.push_back({1, 0, result.objects[static_cast<std::size_t>(d.object)].id, 1,
                         other_from_world * d.world_from_object, -1, ""});
  expect_at_truth(elsewhere, true_results(scene, 0), 0.02);
  EXPECT_TRUE(fs::exists(out / "000001_000000_overlay.png"));
  EXPECT_FALSE(fs::exists(out / "000001_000000.json"));
}

TEST(Register, RefusesCameraPosesThatShareNothing) {
  const TemporaryFolder folder;
  const fs::path scene = folder.path() / "000001", out = folder.path() / "out";
  fs::copy(two_views(), scene, fs::copy_options::recursive);
  save_bop_results(true_results(load_bop_scene(scene), 1), folder.path() / "starts.csv");
  nlohmann::json cameras = nlohmann::json::parse(content_of(scene / "scene_camera.json"));
  for (auto& camera : cameras)
    for (auto& number : camera["cam_t_w2c"]) number = 1000 * number.get<double>();
  std::ofstream(scene / "scene_camera.json") << cameras;
  expect_refused(register_in(scene, folder.path() / "starts.csv", out, {"--multi-view"}),
                 {"000001", "camera poses", "lengths in mm where m are expected"});
  EXPECT_FALSE(fs::exists(out));
}

// Ceres is the reference of the batched solver: both end in the same minima. Without the edge ICP
// that follows, the kinks of the distance transform stop them up to a milliradian apart
// (d2co_ceres_test.cpp).
TEST(Register, EndsInTheSameMinimaWithEitherSolver) {
  const TemporaryFolder folder;
  const std::vector<BopResult> truth = certain_truths(load_bop_scene(one_view()));
  const std::string starts = folder.path() / "starts.csv";
  save_bop_results(perturbed(truth, 0.005, 0.0002, Random(1)), starts);
  const auto refined = [&](const char* solver) {
    const fs::path out = folder.path() / solver;
    const Outcome outcome = run_program(register_in(
        one_view(), starts, out, {"--search-rotation", "0", "--no-overlays", "--solver", solver}));
    EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
    return load_image_result(out / "000000_000000.json").detections;
  };
  const std::vector<Detection> batched = refined("batched"), ceres = refined("ceres");
  ASSERT_EQ(batched.size(), truth.size());
  ASSERT_EQ(ceres.size(), truth.size());
  for (std::size_t i = 0; i < batched.size(); ++i) {
    const Se3 &a = batched[i].world_from_object, &b = ceres[i].world_from_object;
    EXPECT_LT(distance_between_m(a, b), 1e-4) << i;
    EXPECT_LT(a.rotation.angularDistance(b.rotation), 1e-4) << i;
    EXPECT_NEAR(batched[i].probability, ceres[i].probability, 0.02) << "the same features";
    EXPECT_TRUE(ceres[i].covariance.allFinite());
  }
  expect_refused(register_in(one_view(), starts, folder.path() / "no", {"--solver", "newton"}),
                 {"--solver", "newton", "batched, ceres"});
}

TEST(Register, GoesOnPastABadImage) {
  const TemporaryFolder folder;
  fs::copy(two_views(), folder.path() / "000001", fs::copy_options::recursive);
  folder.write("000001/gray/000000.png", "no image");
  const BopScene scene = load_bop_scene(folder.path() / "000001");
  std::vector<BopResult> starts{true_results(scene, 0)[0], true_results(scene, 1)[0]};
  save_bop_results(starts, folder.path() / "starts.csv");
  const fs::path out = folder.path() / "out";
  const Outcome outcome =
      run_program(register_in(folder.path() / "000001", folder.path() / "starts.csv", out,
                              {"--search-rotation", "0", "--no-overlays"}));
  EXPECT_EQ(outcome.exit_code, 1) << outcome.err;
  EXPECT_NE(outcome.err.find("000000.png"), std::string::npos) << outcome.err;
  EXPECT_EQ(load_bop_results(out / "results.csv").size(), 1u);
  EXPECT_TRUE(fs::exists(out / "000001_000001.json"));
  EXPECT_FALSE(fs::exists(out / "000001_000000.json"));
}

// A start in metres in place of millimetres, and a start outside the image: without the check both
// would be registered to something in the image.
TEST(Register, ReportsPosesThatNoImageShows) {
  const TemporaryFolder folder;
  const BopScene scene = load_bop_scene(one_view());
  std::vector<BopResult> starts(3, certain_truths(scene).at(0));
  starts[1].camera_from_object.translation_m *= 1000;
  starts[2].camera_from_object.translation_m.x() += 1;
  save_bop_results(starts, folder.path() / "starts.csv");
  const fs::path out = folder.path() / "out";
  const std::vector<std::string> call = register_in(one_view(), folder.path() / "starts.csv", out,
                                                    {"--search-rotation", "0", "--no-overlays"});
  const Outcome outcome = run_program(call);
  EXPECT_EQ(outcome.exit_code, 1) << outcome.err;
  EXPECT_NE(outcome.out.find("1 poses in 1 images refined on cpu, 2 out of sight"),
            std::string::npos)
      << outcome.out;
  EXPECT_NE(outcome.err.find("000000.png: object"), std::string::npos) << outcome.err;
  const ImageResult result = load_image_result(out / "000000_000000.json");
  ASSERT_EQ(result.detections.size(), 3u);
  EXPECT_GT(result.detections[0].probability, 0.1);
  EXPECT_NE(result.detections[0].convergence, "out of sight");
  for (std::size_t i : {1u, 2u}) {
    EXPECT_EQ(result.detections[i].probability, 0) << i;
    EXPECT_EQ(result.detections[i].convergence, "out of sight") << i;
  }
  EXPECT_EQ(nlohmann::json::parse(content_of(out / "summary.json")).at("poses_out_of_sight"), 2);
  const Outcome again = run_program(joined({call, {"--resume"}}));
  EXPECT_EQ(again.exit_code, 1) << "they are not found by skipping them: " << again.out;
  EXPECT_NE(again.out.find("2 out of sight, 1 images skipped"), std::string::npos) << again.out;
}

struct Refused {
  TemporaryFolder folder;
  fs::path out = folder.path() / "out";
  ~Refused() { EXPECT_FALSE(fs::exists(out)) << "something was written"; }

  std::string starts(const BopResult& start) const {
    save_bop_results({start}, folder.path() / "starts.csv");
    return folder.path() / "starts.csv";
  }
};

BopResult good_start() { return true_results(load_bop_scene(one_view()), 0)[0]; }

TEST(Register, RefusesPosesThatDoNotFit) {
  const Refused t;
  expect_refused(register_in(one_view(), t.folder.path() / "none.csv", t.out), {"none.csv"});
  expect_refused(register_in(one_view(), t.folder.write("cut.json", "[{\"image\": 0"), t.out),
                 {"cut.json"});
  expect_refused(register_in(one_view(), t.folder.write("empty.json", "[]"), t.out),
                 {"empty.json", "poses", "none"});
  expect_refused(register_in(one_view(), t.folder.write("field.json", "[{\"image\": 0}]"), t.out),
                 {"field.json", "object"});
  BopResult start = good_start();
  start.image_id = 7;
  expect_refused(register_in(one_view(), t.starts(start), t.out), {"starts.csv", "image 7"});
  start = good_start();
  start.object_id = 9;
  expect_refused(register_in(one_view(), t.starts(start), t.out), {"starts.csv", "object", "9"});
  start = good_start();
  start.camera_from_object.translation_m.z() *= -1;
  expect_refused(register_in(one_view(), t.starts(start), t.out),
                 {"starts.csv", "behind the camera"});
  start = good_start();
  start.scene_id = 1;
  expect_refused(register_in(one_view(), t.starts(start), t.out), {"starts.csv", "other scenes"});
  expect_refused(
      register_in(two_views() / "gray/000000.png", t.starts(start), t.out, {"--multi-view"}),
      {"000000.png", "world pose"});
}

// The example's, for images outside of its folder.
fs::path camera_file(const TemporaryFolder& folder) {
  return folder.write(
      "camera.json",
      R"({"fx": 700, "fy": 700, "cx": 319.5, "cy": 239.5, "width": 640, "height": 480})");
}

// a/part.png and b/part.png.
std::pair<fs::path, fs::path> two_of_one_name(const fs::path& folder) {
  for (const char* name : {"a", "b"}) {
    fs::create_directories(folder / name);
    fs::copy(one_view() / "gray/000000.png", folder / name / "part.png");
  }
  return {folder / "a/part.png", folder / "b/part.png"};
}

// Results among the images would be images the next time; a start for two images would refine in
// one of them.
TEST(Register, RefusesWhatWouldMixImages) {
  const Refused t;
  const auto [a, b] = two_of_one_name(t.folder.path());
  const std::string starts = t.folder.write(
      "start.json",
      R"([{"image": "part.png", "object": 2, "R": [1,0,0,0,1,0,0,0,1], "t": [0, 0, 0.5]}])");
  const auto in = [&](const std::vector<std::string>& images, const fs::path& out) {
    return joined({{"register"},
                   images,
                   {"--poses", starts, "--out", out, "--device", "cpu"},
                   part_models()});
  };
  expect_refused(in({a}, a.parent_path()), {"--out", "folder of the images"});
  expect_refused(in({a, b}, t.out), {"start.json", "part.png", "a/part.png and ", "single image"});
  EXPECT_EQ(std::distance(fs::directory_iterator(a.parent_path()), {}), 1);
}

// Two images of one name are distinguished by their folders, also after these have moved.
TEST(Register, DistinguishesImagesOfOneNameByTheirFolders) {
  const TemporaryFolder folder;
  const auto [a, b] = two_of_one_name(folder.path());
  const BopResult start = good_start();
  const Eigen::Matrix3d r = start.camera_from_object.rotation.toRotationMatrix();
  nlohmann::json entry{{"image", "elsewhere/b/part.png"}, {"object", start.object_id}};
  for (int i = 0; i < 9; ++i) entry["R"].push_back(r(i / 3, i % 3));
  for (int i = 0; i < 3; ++i) entry["t"].push_back(start.camera_from_object.translation_m[i]);
  const std::string starts = folder.write("start.json", nlohmann::json::array({entry}).dump());
  const fs::path out = folder.path() / "out";
  const Outcome outcome = run_program(joined({{"register", a, b, "--poses", starts, "--out", out,
                                               "--device", "cpu", "--camera", camera_file(folder)},
                                              part_models()}));
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_EQ(load_image_result(out / "part_2.json").image, b);
  EXPECT_FALSE(fs::exists(out / "part.json"));
}

// What cannot be written is no bad image: the batch ends.
TEST(Register, EndsWhereAResultCannotBeWritten) {
  const Refused t;
  const fs::path out = t.folder.path() / "blocked";
  fs::create_directories(out / "000000_000000.json");
  const Outcome outcome = run_program(register_in(one_view(), t.starts(good_start()), out));
  EXPECT_EQ(outcome.exit_code, 2) << outcome.err;
  EXPECT_NE(outcome.err.find("000000_000000.json: output file"), std::string::npos) << outcome.err;
  EXPECT_FALSE(fs::exists(out / "summary.json"));
}

// The folder holds the summary of an earlier run.
TEST(Register, SumsUpWhatEndedIt) {
  const TemporaryFolder folder;
  const BopScene scene = load_bop_scene(two_views());
  save_bop_results({true_results(scene, 0)[0], true_results(scene, 1)[0]},
                   folder.path() / "starts.csv");
  const fs::path out = folder.path() / "out", blocked = out / "000001_000001.json";
  const std::vector<std::string> call = register_in(two_views(), folder.path() / "starts.csv", out,
                                                    {"--search-rotation", "0", "--no-overlays"});
  ASSERT_EQ(run_program(call).exit_code, 0);
  fs::remove(blocked);
  fs::create_directories(blocked);
  ASSERT_EQ(run_program(call).exit_code, 2);
  const auto summary = nlohmann::json::parse(content_of(out / "summary.json"));
  EXPECT_EQ(summary.at("done"), 1);
  EXPECT_NE(summary.at("error").get<std::string>().find("000001_000001.json: output file"),
            std::string::npos)
      << summary;
}

TEST(Register, RefusesOptionsDevicesAndFolders) {
  const Refused t;
  const std::string starts = t.starts(good_start());
  expect_refused(register_in(one_view(), starts, t.out, {"--search-rotation", "1.5"}),
                 {"--search-rotation", "1.5", "0 to 1"});
  expect_refused(register_in(one_view(), starts, t.out, {"--bins", "61"}), {"bins", "61"});
  expect_refused(register_in(one_view(), starts, "/proc/out"), {"/proc/out"});
  // Said before any image is looked at.
  const fs::path broken = t.folder.write("000000.png", "no image");
  expect_refused(
      register_in(broken, starts, "/proc/deeper/out", {"--camera", camera_file(t.folder)}),
      {"/proc/deeper/out", "output folder"});
  expect_refused(register_in(one_view() / "gray/000000.png", starts, t.out),
                 {"000000.png", "camera"});
  const std::string no_drivers = "VK_DRIVER_FILES=/nonexistent VK_ICD_FILENAMES=/nonexistent";
  expect_refused(
      joined({{"register", one_view(), "--poses", starts, "--out", t.out, "--device", "vulkan"},
              part_models()}),
      {"device", "vulkan"}, no_drivers);
  expect_refused({"register", one_view(), "--poses", starts, "--out", t.out},
                 {"--model", "neither"});
}

TEST(Register, NamesTheImageThatIsTooLarge) {
  const Refused t;
  const fs::path wide = t.folder.path() / "wide.png";
  save_png(Image{32767, 120, std::vector<std::uint8_t>(32767 * 120, 128)}, wide);
  const std::string lens = t.folder.write(
      "lens.yaml", "K: [400, 0, 159.5, 0, 400, 119.5, 0, 0, 1]\nD: [0.1, 0, 0, 0, 0]\n");
  expect_refused(
      register_in(wide, t.starts(good_start()), t.out, {"--camera", lens, "--log-level", "error"}),
      {"wide.png: image: size: found 32767x120"});
}

TEST(Register, RefusesTheOnlyImageWhereItIsBad) {
  const Refused t;
  fs::copy(one_view(), t.folder.path() / "000000", fs::copy_options::recursive);
  t.folder.write("000000/gray/000000.png", "no image");
  expect_refused(register_in(t.folder.path() / "000000", t.starts(good_start()), t.out,
                             {"--log-level", "error"}),
                 {"000000.png"});
}

}  // namespace
}  // namespace edgescout::test
