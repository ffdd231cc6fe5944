// The same fisheye camera (Kannala-Brandt) as many programs write it.
#include "tests/io/camera_sample.h"
#include "tests/io/collected_log.h"
#include "tests/io/expect_input_error.h"

namespace edgescout::test {
namespace {

const std::vector<CameraSample> fisheye_samples{
    {"OpenCV sample", "fisheye.yml", R"(%YAML:1.0
---
image_width: 640
image_height: 480
fisheye_model: 1
camera_matrix: !!opencv-matrix
   rows: 3
   cols: 3
   dt: d
   data: [ 700., 0., 321., 0., 701., 238., 0., 0., 1. ]
distortion_coefficients: !!opencv-matrix
   rows: 4
   cols: 1
   dt: d
   data: [ -0.03, 0.01, -0.005, 0.001 ]
)"},
    {"ROS", "camera.yaml", R"(image_width: 640
image_height: 480
distortion_model: equidistant
camera_matrix: {rows: 3, cols: 3, data: [700, 0, 321, 0, 701, 238, 0, 0, 1]}
distortion_coefficients: {rows: 1, cols: 4, data: [-0.03, 0.01, -0.005, 0.001]}
)"},
    {"Kalibr", "camchain.yaml", R"(cam0:
  camera_model: pinhole
  distortion_coeffs: [-0.03, 0.01, -0.005, 0.001]
  distortion_model: equidistant
  intrinsics: [700, 701, 321, 238]
  resolution: [640, 480]
)"},
    {"COLMAP", "cameras.txt",
     "1 OPENCV_FISHEYE 640 480 700 701 321.5 238.5 -0.03 0.01 -0.005 0.001\n"},
    {"camodocal", "cam.yaml", R"(%YAML:1.0
---
model_type: KANNALA_BRANDT
image_width: 640
image_height: 480
projection_parameters:
   k2: -0.03
   k3: 0.01
   k4: -0.005
   k5: 0.001
   mu: 700
   mv: 701
   u0: 321
   v0: 238
)"},
    {"ORB-SLAM3", "tum_vi.yaml", R"(%YAML:1.0
Camera.type: "KannalaBrandt8"
Camera1.fx: 700
Camera1.fy: 701
Camera1.cx: 321
Camera1.cy: 238
Camera1.k1: -0.03
Camera1.k2: 0.01
Camera1.k3: -0.005
Camera1.k4: 0.001
Camera.width: 640
Camera.height: 480
)"},
    {"RealSense", "t265.json", R"({"width": 640, "height": 480, "fx": 700, "fy": 701, "ppx": 321,
 "ppy": 238, "model": "distortion.kannala_brandt4", "coeffs": [-0.03, 0.01, -0.005, 0.001, 0]})"},
    {"Luxonis", "oak.json", R"({"cameraData": [[2, {"cameraType": 1,
 "distortionCoeff": [-0.03, 0.01, -0.005, 0.001, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0], "height": 480,
 "intrinsicMatrix": [[700, 0, 321], [0, 701, 238], [0, 0, 1]], "specHfovDeg": 127,
 "width": 640}]]})"},
    {"OpenCV's namespace", "c.json", R"({"camera_model": "cv::fisheye", "width": 640, "height": 480,
 "K": [700, 0, 321, 0, 701, 238, 0, 0, 1], "D": [-0.03, 0.01, -0.005, 0.001]})"},
    {"Python's namespace", "c.json", R"({"model": "cv2.fisheye", "width": 640, "height": 480,
 "K": [700, 0, 321, 0, 701, 238, 0, 0, 1], "D": [-0.03, 0.01, -0.005, 0.001]})"},
    {"Pupil Labs", "world.json", R"({"camera_matrix": [[700, 0, 321], [0, 701, 238], [0, 0, 1]],
 "dist_coefs": [[-0.03], [0.01], [-0.005], [0.001]], "cam_type": "fisheye",
 "CameraResolution": {"Width": 640, "Height": 480}})"},
    {"Basalt", "calibration.json", R"({"value0": {"intrinsics": [
 {"camera_type": "kb4", "intrinsics": {"fx": 700, "fy": 701, "cx": 321, "cy": 238, "k1": -0.03,
  "k2": 0.01, "k3": -0.005, "k4": 0.001}},
 {"camera_type": "kb4", "intrinsics": {"fx": 700, "fy": 701, "cx": 321, "cy": 238, "k1": -0.03,
  "k2": 0.01, "k3": -0.005, "k4": 0.001}}], "resolution": [[640, 480], [640, 480]]}})"},
};

// Files whose model is only the name of an object.
const std::vector<CameraSample> objects_named_after_the_lens{
    {"fisheye", "c.json", R"({"fisheye": {"width": 640, "height": 480,
 "K": [[700, 0, 321], [0, 701, 238], [0, 0, 1]], "D": [-0.03, 0.01, -0.005, 0.001]}})"},
    {"fisheye_params", "c.json", R"({"width": 640, "height": 480, "fisheye_params": {"fx": 700,
 "fy": 701, "cx": 321, "cy": 238, "k1": -0.03, "k2": 0.01, "k3": -0.005, "k4": 0.001}})"},
    {"fisheye_calibration", "c.yaml", R"(fisheye_calibration:
  image_size: [640, 480]
  K: [700, 0, 321, 0, 701, 238, 0, 0, 1]
  D: [-0.03, 0.01, -0.005, 0.001]
)"},
    {"left_fisheye, pinhole", "c.yaml", R"(left_fisheye:
  camera_model: pinhole
  resolution: [640, 480]
  intrinsics: [700, 701, 321, 238]
  distortion_coeffs: [-0.03, 0.01, -0.005, 0.001]
)"},
    {"calibration/fisheye", "c.json", R"({"calibration": {"fisheye": {"width": 640, "height": 480,
 "K": [700, 0, 321, 0, 701, 238, 0, 0, 1], "dist": [-0.03, 0.01, -0.005, 0.001]}}})"},
    {"kannala_brandt", "c.yaml", R"(width: 640
height: 480
K: [700, 0, 321, 0, 701, 238, 0, 0, 1]
kannala_brandt_distortion: {k1: -0.03, k2: 0.01, k3: -0.005, k4: 0.001}
)"},
};

class FisheyeFile : public testing::TestWithParam<CameraSample> {};

TEST_P(FisheyeFile, GivesTheSameCamera) {
  const Camera camera = load_one(GetParam().file, GetParam().text);
  expect_pinhole(camera);
  EXPECT_EQ(camera.lens, LensModel::Fisheye);
  EXPECT_EQ(camera.distortion, (LensCoefficients{-0.03, 0.01, -0.005, 0.001}));
}

INSTANTIATE_TEST_SUITE_P(CameraFormats, FisheyeFile, testing::ValuesIn(fisheye_samples));
INSTANTIATE_TEST_SUITE_P(NamesOfObjects, FisheyeFile,
                         testing::ValuesIn(objects_named_after_the_lens));

const std::string head =
    R"("fx": 700, "fy": 701, "cx": 321, "cy": 238, "width": 640, "height": 480)";

// k1 to k4 may be a fisheye's, a polynomial's, or a part of OpenCV's rational model.
TEST(CameraFormats, AsksForTheModelOfAFourthCoefficient) {
  const auto refused = [](const std::string& more) {
    expect_input_error([&] { load_one("c.json", "{" + head + ", " + more + "}"); },
                       {"c.json", "k4", "found", "expected", "distortion_model"});
  };
  refused(R"("k1": -0.03, "k2": 0.01, "k3": -0.005, "k4": 0.001)");
  refused(R"("distortion": {"k1": -0.03, "k2": 0.01, "k3": -0.005, "k4": 0.001})");
  refused(R"("coeffs": {"k1": -0.03, "k2": 0.01, "k3": -0.005, "k4": 0})");
  refused(R"("k1": -0.25, "k2": 0.12, "k3": 0.01, "k4": 0.001, "p1": 0.001, "p2": -0.0005)");
  refused(R"("camera_model": "OPENCV", "k1": -0.25, "k2": 0.12, "k3": 0.01, "k4": 0.001, "p1": 0,
 "p2": 0)");
  const auto read = [](const std::string& more) {
    return load_one("c.json", "{" + head + ", " + more + "}");
  };
  EXPECT_EQ(read(R"("k1": -0.25, "k2": 0.12, "k3": 0.01, "k4": 0, "p1": 0.001, "p2": 0)").lens,
            LensModel::BrownConrady);
  EXPECT_EQ(read(R"("k1": 0, "k2": 0, "k3": 0, "k4": 0)").distortion, LensCoefficients{});
  EXPECT_EQ(read(R"("k1": -0.25, "k2": 0.12, "k3": 0.01)").distortion[4], 0.01);
  EXPECT_EQ(read(R"("k1": 1, "k2": 2, "p1": 0.1, "p2": 0.2, "k3": 3, "k4": 4, "k5": 5, "k6": 6)")
                .distortion,
            (LensCoefficients{1, 2, 0.1, 0.2, 3, 4, 5, 6}));
}

TEST(CameraFormats, RefusesObjectsNamedAfterOtherLenses) {
  const std::string camera = "{" + head + R"(, "D": [-0.03, 0.01, -0.005, 0.001]})";
  for (const char* name : {"omnidirectional", "scaramuzza", "double_sphere", "mei"})
    expect_input_error(
        [&] { load_one("c.json", "{\"" + std::string(name) + "\": " + camera + "}"); },
        {"c.json", name, "expected", "kannala_brandt"});
  expect_input_error([&] { load_one("c.json", R"({"fisheye": {)" + head + "}}"); },
                     {"coefficients of the model in fisheye/fx"});
  expect_input_error(
      [&] { load_one("c.json", R"({"fisheye": {)" + head + R"(, "D": [1, 2, 3, 4, 5]}})"); },
      {"fisheye/D", "5 coefficients"});
}

TEST(CameraFormats, TakesNamedModelsBeforeNamesOfObjects) {
  const std::string brown = head + R"(, "distortion_model": "plumb_bob", "D": [1, 2, 0.1, 0.2]})";
  EXPECT_EQ(load_one("c.json", R"({"left_fisheye": {)" + brown + "}").lens,
            LensModel::BrownConrady);
  EXPECT_EQ(load_one("c.json", R"({"fisheye_undistorted": {)" + head + "}}").lens,
            LensModel::BrownConrady);
}

TEST(CameraFormats, WarnsOfNamesThatSpeakOfAFisheye) {
  for (const char* name :
       {R"("camera_name": "fisheye_left")", R"("description": "fisheye lens")"}) {
    const CollectedLog log;
    load_one("c.json", "{" + head + ", " + name + R"(, "D": [-0.03, 0.01, 0, 0]})");
    ASSERT_EQ(log.messages.size(), 1u) << name;
    EXPECT_EQ(log.messages[0].first, LogLevel::Warning);
    EXPECT_NE(log.messages[0].second.find("distortion_model"), std::string::npos);
  }
  // In a list the name is no field.
  const CollectedLog log;
  const Camera camera = load_one(
      "c.json", R"([{"camera_name": "fisheye", )" + head + R"(, "D": [-0.03, 0.01, 0, 0]}])");
  EXPECT_EQ(camera.lens, LensModel::BrownConrady);
  EXPECT_EQ(log.messages.size(), 1u);
}

}  // namespace
}  // namespace edgescout::test
