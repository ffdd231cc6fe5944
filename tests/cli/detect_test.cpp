// edgescout detect on images, folders and scenes: what it writes.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "host/core/pose_error.h"
#include "host/io/results.h"
#include "host/render/renderer.h"
#include "tests/cli/small_scene.h"

namespace edgescout::test {
namespace {

void expect_sound(const ImageResult& result, const fs::path& image) {
  EXPECT_EQ(result.image.filename(), image.filename());
  EXPECT_EQ(result.device, "cpu");
  EXPECT_EQ(result.camera.width, 320);
  EXPECT_EQ(result.camera.fx, 400);
  ASSERT_EQ(result.objects.size(), 1u);
  EXPECT_EQ(result.objects[0].id, 1);
  std::vector<std::string> stages;
  for (const StageSeconds& stage : result.stages) {
    stages.push_back(stage.name);
    EXPECT_GE(stage.seconds, 0) << stage.name;
  }
  EXPECT_EQ(stages,
            (std::vector<std::string>{"decode", "undistort", "edges", "enlargement", "tensors",
                                      "scan", "coarse", "medium", "fine", "selection"}));
  ASSERT_FALSE(result.detections.empty());
  for (std::size_t i = 0; i < result.detections.size(); ++i) {
    const Detection& d = result.detections[i];
    EXPECT_TRUE(d.world_from_object.translation_m.allFinite());
    EXPECT_NEAR(d.world_from_object.rotation.norm(), 1, 1e-9);
    EXPECT_TRUE(d.covariance.allFinite());
    for (double value : {d.probability, d.psi, d.matched_fraction})
      EXPECT_TRUE(value >= 0 && value <= 1) << value;
    EXPECT_TRUE(d.cost_px >= 0 && d.cost_px <= 60) << d.cost_px;
    EXPECT_FALSE(d.convergence.empty());
    EXPECT_LE(d.probability, i > 0 ? result.detections[i - 1].probability : 1);
  }
}

Se3 truth_in(const SmallScene& t, int view) {
  return load_bop_scene(t.scene).truth.at(view).at(0).camera_from_object;
}

// Whether one of the rows of an image is the part where it is.
bool has(const std::vector<BopResult>& rows, int image_id, const Se3& truth,
         double max_angle_rad = 0.05, double max_distance_m = 0.003) {
  return std::any_of(rows.begin(), rows.end(), [&](const BopResult& row) {
    return row.image_id == image_id &&
           pose_error(row.camera_from_object, truth, {}).passes(max_angle_rad, max_distance_m);
  });
}

TEST(Detect, FindsThePartInOneImage) {
  const SmallScene t;
  const Outcome outcome =
      run_program(t.detect(t.image(), joined({bracket(), {"--camera", t.camera()}})));
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_NE(outcome.out.find("1 images: 1 done, 0 skipped, 0 failed"), std::string::npos)
      << outcome.out;
  EXPECT_NE(outcome.err.find("object 1 (obj_000001): diameter 74.9 mm, searched 0.270 to 0.330 m"),
            std::string::npos)
      << outcome.err;
  const ImageResult result = load_image_result(t.out / "000000.json");
  expect_sound(result, t.image());
  EXPECT_EQ(content_of(t.out / "results.csv").find("scene_id,im_id,obj_id,score,R,t,time\n"), 0u);
  const std::vector<BopResult> rows = load_bop_results(t.out / "results.csv");
  EXPECT_TRUE(has(rows, 0, truth_in(t, 0)));
  ASSERT_EQ(rows.size(), result.detections.size());
  for (std::size_t i = 0; i < rows.size(); ++i) {
    EXPECT_EQ(rows[i].score, result.detections[i].probability);
    EXPECT_EQ(rows[i].time_s, rows[0].time_s);
    EXPECT_LT(
        distance_between_m(rows[i].camera_from_object, result.detections[i].world_from_object),
        1e-9);
  }
  EXPECT_GT(rows[0].time_s, 0);
  EXPECT_EQ(load_image(t.out / "000000_overlay.png").width, 320);
  const auto summary = nlohmann::json::parse(content_of(t.out / "summary.json"));
  EXPECT_EQ(summary.at("done"), 1);
  EXPECT_EQ(summary.at("poses"), rows.size());
  EXPECT_TRUE(summary.at("failures").empty());
  EXPECT_NE(outcome.out.find(std::to_string(rows.size()) + " poses in 1 images"), std::string::npos)
      << outcome.out;
}

TEST(Detect, TakesFoldersAndScenes) {
  const SmallScene t(2);
  ASSERT_EQ(run_program(t.detect(t.scene, bracket())).exit_code, 0);
  std::vector<BopResult> rows = load_bop_results(t.out / "results.csv");
  const BopScene scene = load_bop_scene(t.scene);
  for (int image : {0, 1}) {
    // View 1 shows the part from above, 60 px long: its depth is uncertain by millimetres.
    const double max_distance_m = image == 1 ? 0.008 : 0.003;
    EXPECT_TRUE(has(rows, image, truth_in(t, image), 0.1, max_distance_m)) << image;
    const ImageResult result =
        load_image_result(t.out / ("000003_00000" + std::to_string(image) + ".json"));
    expect_sound(result, t.image(image));
    EXPECT_EQ(result.scene_id, 3);
    EXPECT_EQ(result.image_id, image);
    const Se3 camera_from_world =
        scene.images[static_cast<std::size_t>(image)].camera_from_world.value();
    ASSERT_TRUE(result.camera_from_world.has_value());
    EXPECT_LT(distance_between_m(*result.camera_from_world, camera_from_world), 1e-9);
    const Se3 truth_in_world = inverse(camera_from_world) * truth_in(t, image);
    EXPECT_TRUE(std::ranges::any_of(
        result.detections,
        [&](const Detection& d) {
          return pose_error(d.world_from_object, truth_in_world, {}).passes(0.1, max_distance_m);
        }))
        << "the world is the scene's: " << image;
  }
  for (const BopResult& row : rows) EXPECT_EQ(row.scene_id, 3);
  const fs::path other = t.folder.path() / "other";
  ASSERT_EQ(run_program({joined({{"detect", t.scene / "gray", "--out", other, "--device", "cpu",
                                  "--no-overlays", "--camera", t.camera()},
                                 bracket()})})
                .exit_code,
            0);
  rows = load_bop_results(other / "results.csv");
  EXPECT_TRUE(has(rows, 0, truth_in(t, 0)) && has(rows, 1, truth_in(t, 1), 0.1, 0.008));
  EXPECT_TRUE(fs::exists(other / "000001.json"));
  EXPECT_FALSE(fs::exists(other / "000001_overlay.png"));
}

TEST(Detect, JoinsTheViewsOfAScene) {
  const SmallScene t(2);
  ASSERT_EQ(run_program(t.detect(t.scene, joined({bracket(), {"--joint"}}))).exit_code, 0);
  const std::vector<BopResult> rows = load_bop_results(t.out / "results.csv");
  EXPECT_TRUE(has(rows, 0, truth_in(t, 0), 0.05, 0.002) &&
              has(rows, 1, truth_in(t, 1), 0.05, 0.002));
  const ImageResult first = load_image_result(t.out / "000003_000000.json"),
                    second = load_image_result(t.out / "000003_000001.json");
  ASSERT_TRUE(first.camera_from_world && second.camera_from_world);
  ASSERT_EQ(first.detections.size(), second.detections.size());
  for (std::size_t i = 0; i < first.detections.size(); ++i)
    EXPECT_LT(distance_between_m(first.detections[i].world_from_object,
                                 second.detections[i].world_from_object),
              1e-12);
}

TEST(Detect, ATemplateFileAndAConfigurationSayTheSame) {
  const SmallScene t;
  ASSERT_EQ(run_program(t.detect(t.scene, bracket())).exit_code, 0);
  const std::vector<BopResult> direct = load_bop_results(t.out / "results.csv");
  ASSERT_FALSE(direct.empty());
  const auto expect_same = [&](const std::vector<std::string>& arguments) {
    fs::remove_all(t.out);
    const Outcome outcome = run_program(arguments);
    ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
    const std::vector<BopResult> rows = load_bop_results(t.out / "results.csv");
    ASSERT_EQ(rows.size(), direct.size());
    for (std::size_t i = 0; i < rows.size(); ++i) {
      EXPECT_EQ(rows[i].score, direct[i].score);
      EXPECT_EQ(rows[i].camera_from_object.translation_m,
                direct[i].camera_from_object.translation_m);
    }
  };
  const std::string set = t.folder.path() / "part.est";
  ASSERT_EQ(run_program(joined({{"model", "build", part_file(1), "--unit", "mm", "--device", "cpu",
                                 "--out", set},
                                few_templates()}))
                .exit_code,
            0);
  expect_same(t.detect(t.scene, {"--templates", set}));
  const std::string config = t.folder.write(
      "detect.yaml",
      "device: cpu\ndetect:\n  unit: mm\n  viewpoints: 3\n  in-plane-steps: 12\n  "
      "distance-min: 0.27\n  distance-max: 0.33\n  coarse-poses: 200\n  medium-poses: 60\n  "
      "candidates: 10\n  min-probability: 0.1\n  model: [" +
          part_file(1) + "]\n");
  expect_same({"detect", t.scene, "--out", t.out, "--config", config});
}

// One good image among a cut one, a text and one of a single pixel.
struct MixedFolder : SmallScene {
  fs::path images = folder.path() / "images";
  MixedFolder() {
    fs::create_directories(images);
    const std::string good = content_of(image());
    folder.write("images/a_cut.png", good.substr(0, good.size() / 2));
    folder.write("images/b_text.pgm", "P5 says nothing more");
    folder.write("images/c_dot.pgm", "P5\n1 1\n255\nx");
    folder.write("images/d_good.png", good);
    folder.write("images/e_none.png", "");
    folder.write("images/f_good.png", good);
  }
};

TEST(Detect, GoesOnPastBadImages) {
  const MixedFolder t;
  const Outcome outcome =
      run_program(t.detect(t.images, joined({bracket(), {"--camera", t.camera()}})));
  EXPECT_EQ(outcome.exit_code, 1) << outcome.err;
  const auto summary = nlohmann::json::parse(content_of(t.out / "summary.json"));
  EXPECT_EQ(summary.at("images"), 6);
  EXPECT_EQ(summary.at("done"), 2);
  EXPECT_EQ(summary.at("failed"), 4);
  const std::vector<std::pair<std::string, std::string>> reasons{{"a_cut.png", "cut short"},
                                                                 {"b_text.pgm", "no image decoder"},
                                                                 {"c_dot.pgm", "1x1"},
                                                                 {"e_none.png", "empty"}};
  ASSERT_EQ(summary.at("failures").size(), reasons.size());
  for (std::size_t i = 0; i < reasons.size(); ++i) {
    const std::string file = summary["failures"][i].at("file"),
                      error = summary["failures"][i].at("error");
    EXPECT_EQ(fs::path(file).filename(), reasons[i].first);
    EXPECT_NE(error.find(reasons[i].first), std::string::npos) << error;
    EXPECT_NE(error.find(reasons[i].second), std::string::npos) << error;
    EXPECT_NE(outcome.err.find(error), std::string::npos) << outcome.err;
    EXPECT_FALSE(fs::exists(t.out / (fs::path(file).stem().string() + ".json")));
  }
  for (const char* name : {"d_good", "f_good"})
    expect_sound(load_image_result(t.out / (std::string(name) + ".json")),
                 std::string(name) + ".png");
  const std::vector<BopResult> rows = load_bop_results(t.out / "results.csv");
  for (int image : {3, 5}) EXPECT_TRUE(has(rows, image, truth_in(t, 0))) << image;
  for (const BopResult& row : rows)
    EXPECT_TRUE(row.image_id == 3 || row.image_id == 5) << row.image_id;
}

TEST(Detect, ScalesTheCameraWhereAllowed) {
  const SmallScene t;
  const std::string doubled = t.folder.write("camera.yaml",
                                             "image_width: 640\nimage_height: 480\ncamera_matrix: "
                                             "[800, 0, 319.5, 0, 800, 239.5, 0, 0, 1]\n");
  const Outcome outcome = run_program(
      t.detect(t.image(), joined({bracket(), {"--camera", doubled, "--scale-camera"}})));
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_EQ(load_image_result(t.out / "000000.json").camera.fx, 400);
  EXPECT_TRUE(has(load_bop_results(t.out / "results.csv"), 0, truth_in(t, 0)));
}

TEST(Detect, KeepsOverlaysApartFromTheImages) {
  const SmallScene t;
  const fs::path images = t.scene / "gray";
  expect_refused(joined({{"detect", images, "--out", t.scene / "../000003/gray/", "--device", "cpu",
                          "--camera", t.camera()},
                         bracket()}),
                 {"--out", "folder of the images"});
  expect_refused(
      joined({{"detect", t.image(), "--out", images, "--device", "cpu", "--camera", t.camera()},
              bracket()}),
      {"--out", "folder of the images"});
  EXPECT_EQ(std::distance(fs::directory_iterator(images), {}), 1);
}

}  // namespace
}  // namespace edgescout::test
