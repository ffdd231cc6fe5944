// Calibrations as users have them, where EDGESCOUT_FIELD names the folder they lie in: two parts
// must be registered at their true places with every one.
#include "host/io/bop.h"
#include "tests/cli/example_scene.h"
#include "tests/test_random.h"

namespace edgescout::test {
namespace {

struct FieldCamera {
  const char* file;
  const char* image;
};

std::ostream& operator<<(std::ostream& out, const FieldCamera& camera) {
  return out << camera.file;
}

class FieldCameras : public testing::TestWithParam<FieldCamera> {};

TEST_P(FieldCameras, ShowBothPartsAtTheirPlaces) {
  const char* data = std::getenv("EDGESCOUT_FIELD");
  if (!data) GTEST_SKIP() << "no EDGESCOUT_FIELD";
  const fs::path cameras = fs::path(data) / "03-cameras", base = fs::path(data) / "base";
  if (!fs::exists(cameras / GetParam().file))
    GTEST_SKIP() << "EDGESCOUT_FIELD holds no " << GetParam().file;
  const TemporaryFolder folder;
  const std::vector<BopResult> truth = true_results(load_bop_scene(base / "000000"), 0);
  ASSERT_EQ(truth.size(), 2u);
  save_bop_results(perturbed(truth, 0.05, 0.004, test_random()), folder.path() / "starts.csv");
  const Outcome outcome = run_program(
      {"register", cameras / GetParam().image, "--poses", folder.path() / "starts.csv", "--camera",
       cameras / GetParam().file, "--model", base / "models/obj_000001.ply", "--unit", "mm",
       "--object-id", "1", "--device", "cpu", "--no-overlays", "--out", folder.path() / "out"});
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  const std::vector<BopResult> found = load_bop_results(folder.path() / "out/results.csv");
  ASSERT_EQ(found.size(), truth.size());
  for (std::size_t i = 0; i < found.size(); ++i)
    EXPECT_LT(distance_between_m(found[i].camera_from_object, truth[i].camera_from_object), 0.0015);
}

INSTANTIATE_TEST_SUITE_P(Files, FieldCameras,
                         testing::Values(FieldCamera{"a_ros.yaml", "plumb.png"},
                                         FieldCamera{"c_ros2_echo.yaml", "plumb.png"},
                                         FieldCamera{"d_binning2.yaml", "ideal.png"},
                                         FieldCamera{"e_roi_baxter.yaml", "ideal.png"},
                                         FieldCamera{"f_roi_rep104.yaml", "ideal.png"},
                                         FieldCamera{"h_opencv24_sample.yml", "plumb.png"},
                                         FieldCamera{"i_opencv_sample_fisheye.yml", "fisheye.png"},
                                         FieldCamera{"j_opencv3.xml", "plumb.png"},
                                         FieldCamera{"m_python_dist_coeff.yaml", "plumb.png"},
                                         FieldCamera{"q_flat_k1k2.json", "plumb.png"},
                                         FieldCamera{"r1_distortion.json", "plumb.png"},
                                         FieldCamera{"t_megapose.json", "ideal.png"},
                                         FieldCamera{"u_cam_K.txt", "ideal.png"},
                                         FieldCamera{"y_kalibr_camchain.yaml", "plumb.png"},
                                         FieldCamera{"z_ros_radtan.yaml", "plumb.png"}));

}  // namespace
}  // namespace edgescout::test
