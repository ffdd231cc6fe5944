// The same fisheye camera (Kannala-Brandt) as many programs write it.
#include "tests/io/camera_sample.h"

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
    {"Pupil Labs", "world.json", R"({"camera_matrix": [[700, 0, 321], [0, 701, 238], [0, 0, 1]],
 "dist_coefs": [[-0.03], [0.01], [-0.005], [0.001]], "cam_type": "fisheye",
 "CameraResolution": {"Width": 640, "Height": 480}})"},
    {"Basalt", "calibration.json", R"({"value0": {"intrinsics": [
 {"camera_type": "kb4", "intrinsics": {"fx": 700, "fy": 701, "cx": 321, "cy": 238, "k1": -0.03,
  "k2": 0.01, "k3": -0.005, "k4": 0.001}},
 {"camera_type": "kb4", "intrinsics": {"fx": 700, "fy": 701, "cx": 321, "cy": 238, "k1": -0.03,
  "k2": 0.01, "k3": -0.005, "k4": 0.001}}], "resolution": [[640, 480], [640, 480]]}})"},
};

class FisheyeFile : public testing::TestWithParam<CameraSample> {};

TEST_P(FisheyeFile, GivesTheSameCamera) {
  const Camera camera = load_one(GetParam().file, GetParam().text);
  expect_pinhole(camera);
  EXPECT_EQ(camera.lens, LensModel::Fisheye);
  EXPECT_EQ(camera.distortion, (LensCoefficients{-0.03, 0.01, -0.005, 0.001}));
}

INSTANTIATE_TEST_SUITE_P(CameraFormats, FisheyeFile, testing::ValuesIn(fisheye_samples));

}  // namespace
}  // namespace edgescout::test
