// The main jobs on photographs, with the CAD model that came with them: a cube on a desk.
#include <gtest/gtest.h>

#include <fstream>
#include <nlohmann/json.hpp>

#include "host/core/pose_error.h"
#include "host/io/bop.h"
#include "tests/cli/example_scene.h"

namespace edgescout::test {
namespace {

// Where Debian's package visp-images-data is installed.
const fs::path photographs = "/usr/share/visp-images-data/ViSP-images/mbt";
constexpr char no_photographs[] = "visp-images-data is not installed";

struct Photograph : ::testing::TestWithParam<const char*> {
  const fs::path visp = examples() / "visp";
  // As registered from the overlay's eight corners, none of which is a pixel off; mm.
  const Se3 cube{Eigen::Quaterniond((Eigen::Matrix3d() << -0.545640, -0.837721, 0.022351,  //
                                     -0.585324, 0.361885, -0.725559,                       //
                                     0.599728, -0.408976, -0.687797)
                                        .finished()),
                 {0.04585, 0.03015, 0.59731}};

  void SetUp() override {
    if (!fs::exists(photographs)) GTEST_SKIP() << no_photographs;
    if (std::string(GetParam()) == "vulkan" &&
        run_program({"devices", "--device", "vulkan"}).exit_code != 0)
      GTEST_SKIP() << "no Vulkan device";
  }
};

TEST_P(Photograph, ShowsACubeThatIsFound) {
  const TemporaryFolder out;
  const Outcome outcome = run_program(joined(
      {{"detect", photographs / "cube/image0000.pgm", "--out", out.path(), "--device", GetParam()},
       {"--model", photographs / "cube.cao", "--unit", "m", "--models-info",
        visp / "cube_models_info.json"},
       {"--camera", visp / "cube_camera.yaml", "--distance-min", "0.4", "--distance-max", "0.8"},
       {"--viewpoints", "3", "--coarse-poses", "300", "--candidates", "10", "--max-detections",
        "1"},
       {"--region-x", "250", "--region-y", "150", "--region-width", "250", "--region-height",
        "250"}}));
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  const std::vector<BopResult> found = load_bop_results(out.path() / "results.csv");
  ASSERT_EQ(found.size(), 1u);
  const PoseError error = pose_error(found[0].camera_from_object, cube,
                                     load_symmetries(visp / "cube_models_info.json").at(1));
  EXPECT_LT(error.distance_m, 0.002);
  EXPECT_LT(error.angle_rad, 0.01);
  EXPECT_TRUE(fs::exists(out.path() / "image0000_overlay.png"));
}

// From ViSP's pose in the first image to the last one, where a tube hides an edge.
TEST(Photographs, OfACubeAreFollowedToTheLast) {
  if (!fs::exists(photographs)) GTEST_SKIP() << no_photographs;
  const fs::path visp = examples() / "visp";
  const TemporaryFolder out;
  const Outcome outcome =
      run_program({"track", photographs / "cube", "--model", photographs / "cube.cao", "--unit",
                   "m", "--camera", visp / "cube_camera.yaml", "--poses", visp / "cube_pose.json",
                   "--no-search", "--no-overlays", "--device", "cpu", "--out", out.path()});
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  const auto summary = nlohmann::json::parse(std::ifstream(out.path() / "summary.json"));
  EXPECT_EQ(summary["frames"], 218);
  EXPECT_EQ(summary["instances"], 1);
  EXPECT_EQ(summary["losses"], 0);
  EXPECT_EQ(summary["lost"], 0);
  EXPECT_GE(summary["tracked"].get<int>(), 215);
}

INSTANTIATE_TEST_SUITE_P(On, Photograph, ::testing::Values("cpu", "vulkan"),
                         [](const auto& device) { return std::string(device.param); });

}  // namespace
}  // namespace edgescout::test
