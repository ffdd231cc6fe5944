// Calibrations as users have them, where EDGESCOUT_FIELD names the folder they lie in: two parts
// must be found at their true places with every one.
#include "host/io/bop.h"
#include "tests/cli/example_scene.h"

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

TEST_P(FieldCameras, FindBothParts) {
  const char* data = std::getenv("EDGESCOUT_FIELD");
  if (!data) GTEST_SKIP() << "no EDGESCOUT_FIELD";
  const fs::path cameras = fs::path(data) / "03-cameras", base = fs::path(data) / "base";
  if (!fs::exists(cameras / GetParam().file))
    GTEST_SKIP() << "EDGESCOUT_FIELD holds no " << GetParam().file;
  const TemporaryFolder out;
  const Outcome outcome = run_program(
      {"detect", cameras / GetParam().image, "--camera", cameras / GetParam().file, "--model",
       base / "models/obj_000001.ply", "--unit", "mm", "--object-id", "1", "--distance-min", "0.18",
       "--distance-max", "0.32", "--device", "cpu", "--no-overlays", "--out", out.path()});
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  const BopScene scene = load_bop_scene(base / "000000");
  const std::vector<BopResult> found = load_bop_results(out.path() / "results.csv");
  for (const BopTruth& truth : scene.truth.at(0)) {
    double least_m = 1;
    for (const BopResult& result : found)
      if (result.score > 0.5)
        least_m = std::min(least_m, (result.camera_from_object.translation_m -
                                     truth.camera_from_object.translation_m)
                                        .norm());
    EXPECT_LT(least_m, 0.0015);
  }
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
