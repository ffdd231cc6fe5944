// --depth of detect, register and scout.
#include <gtest/gtest.h>

#include <fstream>
#include <nlohmann/json.hpp>
#include <opencv2/core.hpp>
#include <opencv2/imgcodecs.hpp>

#include "tests/cli/small_scene.h"
#include "tests/cli/small_scout.h"

namespace edgescout::test {
namespace {

// The small scene with depth images that are 0.1 mm a unit.
struct DepthScene {
  int views;
  SmallScene made;
  fs::path depth = made.scene / "depth";

  explicit DepthScene(int count = 1) : views(count), made(count) {}

  // In metres; 0: nothing is measured.
  void write_depth(double z_m, int width, int height) const {
    write(0, cv::Mat(height, width, CV_16U, cv::Scalar(z_m * 1e4)));
  }
  // What is there. `units`: of 0.1 mm; `is_mirrored`: as if it were another frame's.
  void write_true_depth(double units = 1, bool is_mirrored = false) const {
    const std::vector<Object> parts{make_part("l_bracket")};
    ThreadPool pool(2);
    std::vector<Rendering> seen = render(make_scene(parts, bare_board(1, views)), pool);
    for (int i = 0; i < views; ++i) {
      cv::Mat stored;
      cv::Mat(240, 320, CV_32F, seen[std::size_t(i)].depth_m.data())
          .convertTo(stored, CV_16U, 1e4 * units);
      if (is_mirrored) cv::flip(stored, stored, 1);
      write(i, stored);
    }
  }
  void write(int image, const cv::Mat& stored) const {
    fs::create_directories(depth);
    cv::imwrite((depth / ("00000" + std::to_string(image) + ".png")).string(), stored);
    nlohmann::json cameras = nlohmann::json::parse(content_of(made.scene / "scene_camera.json"));
    cameras[std::to_string(image)]["depth_scale"] = 0.1;
    std::ofstream(made.scene / "scene_camera.json") << cameras;
  }
  std::vector<std::string> detect(const std::vector<std::string>& more) const {
    return made.detect(made.scene, joined({bracket(), {"--no-overlays"}, more}));
  }
  nlohmann::json detections() const {
    return nlohmann::json::parse(content_of(made.out / "000003_000000.json"))["detections"];
  }
};

// Only the batch finds out: what it logs comes before the error.
void expect_refused_in_the_batch(const std::vector<std::string>& arguments,
                                 std::initializer_list<std::string> words) {
  const Outcome outcome = run_program(arguments);
  EXPECT_EQ(outcome.exit_code, 2) << outcome.err;
  const std::size_t error = outcome.err.find("edgescout: error: ");
  ASSERT_NE(error, std::string::npos) << outcome.err;
  EXPECT_TRUE(is_one_line_error(outcome.err.substr(error))) << outcome.err;
  for (const std::string& word : words)
    EXPECT_NE(outcome.err.find(word, error), std::string::npos) << word << ": " << outcome.err;
}

TEST(DepthOption, WithoutAnyValueDetectionsAreThoseWithoutDepth) {
  const DepthScene t;
  t.write_depth(0, 320, 240);
  const Outcome with = run_program(t.detect({"--depth", "scene"}));
  ASSERT_EQ(with.exit_code, 0) << with.err;
  const nlohmann::json found = t.detections();
  EXPECT_FALSE(found.empty());
  fs::remove_all(t.made.out);
  ASSERT_EQ(run_program(t.detect({})).exit_code, 0);
  EXPECT_EQ(found, t.detections());
}

// A wall before all parts: none can be there.
TEST(DepthOption, PartsBehindAMeasuredSurfaceAreNotFound) {
  const DepthScene t;
  t.write_depth(0.1, 320, 240);
  const Outcome outcome = run_program(t.detect({"--depth", "scene"}));
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_TRUE(t.detections().empty());
}

TEST(DepthOption, RefusesAnotherSize) {
  const DepthScene t;
  t.write_depth(0.3, 160, 120);
  expect_refused_in_the_batch(t.detect({"--depth", "scene"}),
                              {"000000.png", "size", "depth-camera"});
}

TEST(DepthOption, RefusesAWrongUnit) {
  const DepthScene t;
  t.write_depth(0.3, 320, 240);
  expect_refused_in_the_batch(t.detect({"--depth", "scene", "--depth-unit", "0.1"}),
                              {"000000.png", "values: found around 3000", "300 m", "depth-unit"});
}

// What is said of depth that cannot be that of the images, by each verb.
TEST(DepthOption, WarningsAreLoggedOnceWithTheirNumber) {
  const DepthScene t(2);
  const std::string starts = t.made.folder.write("starts.csv",
                                                 "scene_id,im_id,obj_id,score,R,t,time\n"
                                                 "3,0,1,1,1 0 0 0 1 0 0 0 1,0 0 300,-1\n"
                                                 "3,1,1,1,1 0 0 0 1 0 0 0 1,0 0 300,-1\n");
  const std::vector<std::string> registers = {
      "register", t.made.scene, "--poses",  starts, "--model", part_file(1), "--unit",       "mm",
      "--out",    t.made.out,   "--device", "cpu",  "--depth", "scene",      "--no-overlays"};
  const std::string other = "is it the depth of another image?",
                    unit = "is the depth of another unit (--depth-unit)?";
  const auto expect_said = [&](const std::string& what) {
    for (const auto& arguments : {t.detect({"--depth", "scene"}), registers}) {
      fs::remove_all(t.made.out);
      const Outcome outcome = run_program(arguments);
      EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
      for (const std::string& warning : {other, unit})
        EXPECT_EQ(count_of(outcome.err, warning), warning == what ? 1u : 0u) << outcome.err;
      EXPECT_EQ(count_of(outcome.err, "so in 2 of 2 images with depth"), what.empty() ? 0u : 1u)
          << outcome.err;
    }
  };
  t.write_true_depth();
  expect_said("");
  t.write_true_depth(1, true);
  expect_said(other);
  t.write_true_depth(10);
  expect_said(unit);
}

TEST(DepthOption, RefusesDepthThatIsNotThere) {
  const DepthScene t;
  expect_refused(t.detect({"--depth-noise", "0.01"}), {"--depth-noise", "it without --depth"});
  expect_refused(t.detect({"--depth", "scene"}), {"--depth", "scenes with depth/"});
  expect_refused(t.detect({"--depth", t.made.folder.path()}), {"--depth", "names of the images"});
  expect_refused_in_the_batch(t.detect({"--depth", t.made.folder.path() / "none.png"}),
                              {"none.png"});
  expect_refused(t.detect({"--depth", "scene", "--depth-pose", "0", "0", "0", "0", "0", "0", "1"}),
                 {"--depth"});
}

TEST(DepthOption, OfAScoutIsTheSensorOfACell) {
  SmallScout t;
  ASSERT_EQ(run_program(t.arguments({"--depth", "scene", "--depth-holes", "0.5"})).exit_code, 0);
  const nlohmann::json with = t.log();
  ASSERT_EQ(with.at("steps").size(), 2u);
  EXPECT_GT(with["steps"][0].at("depth_measured"), 0.5);
  EXPECT_LT(with["steps"][0].at("depth_measured"), 1);
  ASSERT_EQ(with.at("detections").size(), 1u);
  EXPECT_TRUE(with["detections"][0].at("off_truth").at("right"));
  expect_refused(t.arguments({"--depth", "folder"}), {"--depth", "folder for a cell", "scene"});
  expect_refused(t.arguments({"--depth-holes", "0.5"}), {"--depth-holes", "it without --depth"});
}

TEST(DepthOption, OfAScoutIsThatOfRecordedViews) {
  const DepthScene t;
  t.write_depth(0.3, 320, 240);
  const auto scout = [&](const std::vector<std::string>& more) {
    return joined({{"scout", t.made.scene, "--out", t.made.out, "--device", "cpu", "--coarse-poses",
                    "200", "--max-views", "1"},
                   bracket(),
                   more});
  };
  ASSERT_EQ(run_program(scout({"--depth", "scene"})).exit_code, 0);
  const auto log = [&] { return nlohmann::json::parse(content_of(t.made.out / "scout.json")); };
  EXPECT_EQ(log()["steps"][0].at("depth_measured"), 1);
  ASSERT_EQ(run_program(scout({})).exit_code, 0);
  EXPECT_TRUE(log()["steps"][0].at("depth_measured").is_null());
  expect_refused(scout({"--depth-bias", "0.01"}), {"--depth-bias", "recorded views"});
  fs::remove_all(t.depth);
  expect_refused(scout({"--depth", "scene"}), {"--depth", "depth/"});
}

}  // namespace
}  // namespace edgescout::test
