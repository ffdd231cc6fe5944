// One camera as many programs write it: every file must give the same numbers.
#include <gtest/gtest.h>

#include "host/io/camera_file.h"
#include "tests/io/expect_input_error.h"
#include "tests/io/temporary_folder.h"

namespace edgescout::test {
namespace {

struct CameraSample {
  const char* format;
  const char* file;
  std::string text;
};

std::ostream& operator<<(std::ostream& out, const CameraSample& sample) {
  return out << sample.format;
}

std::vector<FileCamera> load_text(const std::string& file, const std::string& text) {
  const TemporaryFolder folder;
  return load_cameras(folder.write(file, text));
}

Camera load_one(const std::string& file, const std::string& text, const std::string& name = "") {
  const TemporaryFolder folder;
  return load_camera(folder.write(file, text), name);
}

void expect_pinhole(const Camera& camera, int width = 640, int height = 480) {
  EXPECT_EQ(camera.width, width);
  EXPECT_EQ(camera.height, height);
  EXPECT_NEAR(camera.fx, 700, 1e-9);
  EXPECT_NEAR(camera.fy, 701, 1e-9);
  EXPECT_NEAR(camera.cx, 321, 1e-9);
  EXPECT_NEAR(camera.cy, 238, 1e-9);
  EXPECT_EQ(camera.skew, 0);
}

// With k1 -0.25, k2 0.12, p1 0.001, p2 -0.0005, k3 0.
const std::vector<CameraSample> brown_samples{
    {"ROS 1 file", "camera.yaml", R"(image_width: 640
image_height: 480
camera_name: cam
camera_matrix:
  rows: 3
  cols: 3
  data: [700, 0, 321, 0, 701, 238, 0, 0, 1]
distortion_model: plumb_bob
distortion_coefficients: {rows: 1, cols: 5, data: [-0.25, 0.12, 0.001, -0.0005, 0]}
rectification_matrix: {rows: 3, cols: 3, data: [1, 0, 0, 0, 1, 0, 0, 0, 1]}
projection_matrix: {rows: 3, cols: 4, data: [650, 0, 320, 0, 0, 650, 240, 0, 0, 0, 1, 0]}
)"},
    {"ROS 1 echo, twice", "echo.txt", R"(header:
  seq: 7
  stamp: {secs: 1, nsecs: 2}
  frame_id: "cam"
height: 480
width: 640
distortion_model: "plumb_bob"
D: [-0.25, 0.12, 0.001, -0.0005, 0.0]
K: [700.0, 0.0, 321.0, 0.0, 701.0, 238.0, 0.0, 0.0, 1.0]
R: [1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0]
P: [1.0, 0.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 0.0, 1.0, 0.0]
binning_x: 0
binning_y: 0
roi:
  x_offset: 0
  y_offset: 0
  height: 0
  width: 0
  do_rectify: False
---
height: 480
width: 640
distortion_model: "plumb_bob"
D: [-0.25, 0.12, 0.001, -0.0005, 0.0]
K: [700.0, 0.0, 321.0, 0.0, 701.0, 238.0, 0.0, 0.0, 1.0]
---
)"},
    {"ROS 2 echo", "camera_info.yaml", R"(header:
  stamp:
    sec: 1
    nanosec: 2
  frame_id: cam
height: 480
width: 640
distortion_model: rational_polynomial
d:
- -0.25
- 0.12
- 0.001
- -0.0005
- 0.0
- 0.0
- 0.0
- 0.0
k:
- 700.0
- 0.0
- 321.0
- 0.0
- 701.0
- 238.0
- 0.0
- 0.0
- 1.0
roi: {x_offset: 0, y_offset: 0, height: 480, width: 640, do_rectify: false}
---
)"},
    {"ROS ost.txt", "ost.txt", R"(# oST version 5.0 parameters


[image]

width
640

height
480

[narrow_stereo]

camera matrix
700.000000 0.000000 321.000000
0.000000 701.000000 238.000000
0.000000 0.000000 1.000000

distortion
-0.25 0.12 0.001 -0.0005 0.000000

rectification
1.000000 0.000000 0.000000
0.000000 1.000000 0.000000
0.000000 0.000000 1.000000

projection
650.0 0.000000 320.0 0.000000
0.000000 650.0 240.0 0.000000
0.000000 0.000000 1.000000 0.000000
)"},
    {"OpenCV 2.4 sample, no ---, CRLF", "out.yml",
     "%YAML:1.0\r\ncalibration_Time: \"today\"\r\nimage_Width: 640\r\nimage_Height: 480\r\n"
     "flagValue: 0\r\nCamera_Matrix: !!opencv-matrix\r\n   rows: 3\r\n   cols: 3\r\n   dt: d\r\n"
     "   data: [ 700., 0., 321., 0., 701., 238., 0., 0., 1. ]\r\n"
     "Distortion_Coefficients: !!opencv-matrix\r\n   rows: 5\r\n   cols: 1\r\n   dt: d\r\n"
     "   data: [ -2.5e-01, 1.2e-01, 1.0e-03,\r\n       -5.0e-04, 0. ]\r\n"},
    {"OpenCV XML", "out.xml", R"(<?xml version="1.0"?>
<!-- a comment -->
<opencv_storage>
<image_width>640</image_width>
<image_height>480</image_height>
<camera_matrix type_id="opencv-matrix">
  <rows>3</rows> <cols>3</cols> <dt>d</dt>
  <data>
    700. 0. 3.21e+02 0. 701. 238. 0. 0.
    1.</data></camera_matrix>
<distortion_coefficients type_id="opencv-matrix">
  <rows>5</rows> <cols>1</cols> <dt>d</dt>
  <data>
    -2.5e-01 1.2e-01 1.0e-03 -5.0e-04 0.</data></distortion_coefficients>
</opencv_storage>
)"},
    {"OpenCV JSON", "out.json", R"({"image_width": 640, "image_height": 480, "camera_matrix":
 {"type_id": "opencv-matrix", "rows": 3, "cols": 3, "dt": "d",
  "data": [ 700.0, 0.0, 321.0, 0.0, 701.0, 238.0, 0.0, 0.0, 1.0 ]},
 "distortion_coefficients": {"type_id": "opencv-matrix", "rows": 1, "cols": 5, "dt": "d",
  "data": [ -0.25, 0.12, 0.001, -0.0005, 0.0 ]}, "avg_reprojection_error": 0.2})"},
    {"Python, nested lists, BOM", "calib.yaml",
     "\xef\xbb\xbf"
     R"(camera_matrix: [[700, 0, 321], [0, 701, 238], [0, 0, 1]]
dist_coeff:
- [-0.25, 0.12, 0.001, -0.0005, 0]
image_size: [640, 480]  # width, height
)"},
    {"flat JSON with comments", "camera.json", R"({
 // by hand
 "fx": 700, "fy": 701, "cx": 321, "cy": 238, "width": 640, "height": 480,
 "k1": -0.25, "k2": 0.12, "p1": 0.001, "p2": -0.0005, "k3": 0})"},
    {"nested JSON", "camera.json", R"({"resolution": {"width": 640, "height": 480},
 "intrinsics": {"fx": 700, "fy": 701, "ppx": 321, "ppy": 238},
 "distortion": {"model": "brown_conrady", "coefficients": [-0.25, 0.12, 0.001, -0.0005, 0]}})"},
    {"Kalibr", "camchain.yaml", R"(cam0:
  cam_overlaps: []
  camera_model: pinhole
  distortion_coeffs: [-0.25, 0.12, 0.001, -0.0005]
  distortion_model: radtan
  intrinsics: [700, 701, 321, 238]
  resolution: [640, 480]
  rostopic: /cam0/image_raw
)"},
    {"leading tabs", "camera.yaml",
     "image_width:\t640\nimage_height:\t480\ncamera_matrix:\n"
     "\trows: 3\n\tdata: [700, 0, 321, 0, 701, 238, 0, 0, 1]\nD: [-0.25, 0.12, 0.001, -0.0005]\n"},
    {"Azure Kinect SDK", "k4a.json", R"({"color_camera": {"intrinsics": {"parameters": {"fx": 700,
 "fy": 701, "cx": 321, "cy": 238, "k1": -0.25, "k2": 0.12, "p1": 0.001, "p2": -0.0005, "k3": 0,
 "codx": 0, "cody": 0, "metric_radius": 1.7}}, "resolution_width": 640, "resolution_height": 480}})"},
    {"nerfstudio", "transforms.json", R"({"fl_x": 700, "fl_y": 701, "cx": 321, "cy": 238, "w": 640,
 "h": 480, "k1": -0.25, "k2": 0.12, "p1": 0.001, "p2": -0.0005, "camera_model": "OPENCV",
 "frames": [{"file_path": "a.png"}]})"},
    {"TOML", "camera.toml",
     "[camera]\nfx = 700 # px\nfy = 701\ncx = 321\ncy = 238\n"
     "width = 640\nheight = 480\ndistortion = [-0.25, 0.12, 0.001, -0.0005]\n"},
    {"EuRoC", "sensor.yaml", R"(# General sensor definitions.
sensor_type: camera
comment: VI-Sensor cam0
T_BS:
  cols: 4
  rows: 4
  data: [1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1]
rate_hz: 20
resolution: [640, 480]
camera_model: pinhole
intrinsics: [700, 701, 321, 238] #fu, fv, cu, cv
distortion_model: radial-tangential
distortion_coefficients: [-0.25, 0.12, 0.001, -0.0005]
)"},
    {"camodocal", "cam.yaml", R"(%YAML:1.0
---
model_type: PINHOLE
camera_name: camera
image_width: 640
image_height: 480
distortion_parameters: {k1: -0.25, k2: 0.12, p1: 0.001, p2: -0.0005}
projection_parameters: {fx: 700, fy: 701, cx: 321, cy: 238}
)"},
    {"ORB-SLAM", "tum.yaml", R"(%YAML:1.0
Camera.type: "PinHole"
Camera.fx: 700
Camera.fy: 701
Camera.cx: 321
Camera.cy: 238
Camera.k1: -0.25
Camera.k2: 0.12
Camera.p1: 0.001
Camera.p2: -0.0005
Camera.width: 640
Camera.height: 480
Camera.fps: 30.0
)"},
    {"MATLAB before R2022b", "matlab.json", R"({"ImageSize": [480, 640],
 "RadialDistortion": [-0.25, 0.12], "TangentialDistortion": [0.001, -0.0005],
 "IntrinsicMatrix": [[700, 0, 0], [0, 701, 0], [322, 239, 1]], "WorldUnits": "millimeters",
 "EstimateSkew": false, "NumRadialDistortionCoefficients": 2, "EstimateTangentialDistortion": true,
 "FocalLength": [700, 701], "PrincipalPoint": [322, 239], "Skew": 0})"},
    {"MATLAB R2022b", "matlab.json",
     R"({"ImageSize": [480, 640], "RadialDistortion": [-0.25, 0.12, 0],
 "TangentialDistortion": [0.001, -0.0005], "K": [[700, 0, 322], [0, 701, 239], [0, 0, 1]]})"},
    {"COLMAP", "cameras.txt", R"(# Camera list with one line of data per camera:
#   CAMERA_ID, MODEL, WIDTH, HEIGHT, PARAMS[]
# Number of cameras: 1
1 OPENCV 640 480 700 701 321.5 238.5 -0.25 0.12 0.001 -0.0005
)"},
    {"COLMAP, all coefficients", "cameras.txt",
     "7 FULL_OPENCV 640 480 700 701 321.5 238.5 -0.25 0.12 0.001 -0.0005 0 0 0 0\n"},
    {"ZED", "SN1.conf",
     "[LEFT_CAM_VGA]\nfx=700\nfy=701\ncx=321\ncy=238\nk1=-0.25\nk2=0.12\n"
     "p1=0.001\np2=-0.0005\nk3=0\nwidth=640\nheight=480\n"},
    {"RealSense, text of one stream", "rs.yaml",
     "Width: 640\nHeight: 480\nPPX: 321\nPPY: 238\n"
     "Fx: 700\nFy: 701\nDistortion: Brown Conrady\nCoeffs: -0.25  0.12  0.001  -0.0005  0\n"},
};

class BrownConradyFile : public testing::TestWithParam<CameraSample> {};

TEST_P(BrownConradyFile, GivesTheSameCamera) {
  const Camera camera = load_one(GetParam().file, GetParam().text);
  expect_pinhole(camera);
  EXPECT_EQ(camera.lens, LensModel::BrownConrady);
  EXPECT_EQ(camera.distortion, (LensCoefficients{-0.25, 0.12, 0.001, -0.0005}));
}
INSTANTIATE_TEST_SUITE_P(CameraFormats, BrownConradyFile, testing::ValuesIn(brown_samples));

const std::vector<CameraSample> pinhole_samples{
    {"Open3D", "open3d.json", R"({"width": 640, "height": 480,
 "intrinsic_matrix": [700, 0, 0, 0, 701, 0, 321, 238, 1]})"},
    {"Open3D with extrinsics", "open3d.json", R"({"class_name": "PinholeCameraParameters",
 "extrinsic": [1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1], "intrinsic": {"height": 480,
 "intrinsic_matrix": [700, 0, 0, 0, 701, 0, 321, 238, 1], "width": 640}, "version_major": 1})"},
    {"MegaPose", "camera_data.json",
     R"({"K": [[700, 0, 321], [0, 701, 238], [0, 0, 1]], "resolution": [480, 640]})"},
    {"BOP camera.json", "camera.json",
     R"({"cx": 321, "cy": 238, "fx": 700, "fy": 701, "width": 640, "height": 480, "depth_scale": 0.1})"},
    {"BOP cam_model", "scene_camera.json", R"({"0": {"cam_model": {"image_width": 640,
 "image_height": 480, "projection_model_type": "CameraModelType.PINHOLE",
 "projection_params": [700, 701, 321, 238]}, "depth_scale": 1}})"},
    {"COLMAP", "cameras.txt", "1 PINHOLE 640 480 700 701 321.5 238.5\n"},
    {"pycolmap", "camera.json", R"({"camera_id": 1, "model": "PINHOLE", "width": 640, "height": 480,
 "params": [700, 701, 321.5, 238.5]})"},
    {"ROS, region and binning", "camera_info.yaml", R"(height: 1200
width: 1600
distortion_model: plumb_bob
D: [0, 0, 0, 0, 0]
K: [1400, 0, 762.5, 0, 1402, 576.5, 0, 0, 1]
binning_x: 2
binning_y: 2
roi: {x_offset: 120, y_offset: 100, height: 960, width: 1280, do_rectify: true}
)"},
    {"ROS, size of the region", "camera_info.yaml", R"(height: 480
width: 640
K: [700, 0, 641, 0, 701, 438, 0, 0, 1]
roi: {x_offset: 320, y_offset: 200, height: 480, width: 640}
)"},
};

class PinholeFile : public testing::TestWithParam<CameraSample> {};

TEST_P(PinholeFile, GivesTheSameCamera) {
  const Camera camera = load_one(GetParam().file, GetParam().text);
  expect_pinhole(camera);
  EXPECT_FALSE(camera.has_distortion());
}
INSTANTIATE_TEST_SUITE_P(CameraFormats, PinholeFile, testing::ValuesIn(pinhole_samples));

const std::vector<CameraSample> sizeless_samples{
    {"cam_K.txt", "cam_K.txt", "7.000e+02 0.000e+00 3.210e+02\n0 701 238\n0 0 1\n"},
    {"with tabs", "K.txt", "700\t0\t321\r\n0\t701\t238\r\n0\t0\t1\r\n"},
    {"printed by numpy", "K.txt", "[[700.   0. 321.]\n [  0. 701. 238.]\n [  0.   0.   1.]]\n"},
    {"with commas and a comment", "intrinsics.csv", "# K\n700,0,321\n0,701,238\n0,0,1\n"},
    {"4x4", "intrinsic_color.txt", "700 0 321 0\n0 701 238 0\n0 0 1 0\n0 0 0 1\n"},
    {"four numbers", "intrinsics.txt", "700 701 321 238\n"},
    {"BOP scene_camera.json", "scene_camera.json",
     R"({"0": {"cam_K": [700, 0, 321, 0, 701, 238, 0, 0, 1], "depth_scale": 1.0},
 "5": {"cam_K": [700, 0, 321, 0, 701, 238, 0, 0, 1], "depth_scale": 1.0}})"},
};

class SizelessFile : public testing::TestWithParam<CameraSample> {};

TEST_P(SizelessFile, GivesTheSameCamera) {
  const Camera camera = load_one(GetParam().file, GetParam().text);
  expect_pinhole(camera, 0, 0);
  EXPECT_FALSE(camera.has_distortion());
}
INSTANTIATE_TEST_SUITE_P(CameraFormats, SizelessFile, testing::ValuesIn(sizeless_samples));

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
};

class FisheyeFile : public testing::TestWithParam<CameraSample> {};

TEST_P(FisheyeFile, GivesTheSameCamera) {
  const Camera camera = load_one(GetParam().file, GetParam().text);
  expect_pinhole(camera);
  EXPECT_EQ(camera.lens, LensModel::Fisheye);
  EXPECT_EQ(camera.distortion, (LensCoefficients{-0.03, 0.01, -0.005, 0.001}));
}
INSTANTIATE_TEST_SUITE_P(CameraFormats, FisheyeFile, testing::ValuesIn(fisheye_samples));

TEST(CameraFormats, ReadsRealSenseModels) {
  const auto json = [](const std::string& model) {
    return R"({"width": 640, "height": 480, "fx": 700, "fy": 701, "ppx": 321, "ppy": 238, "coeffs":
 [-0.05, 0.06, 0.001, 0.002, -0.02], "model": )" +
           model + "}";
  };
  for (const char* model : {"\"distortion.inverse_brown_conrady\"", "\"Inverse Brown Conrady\"",
                            "\"RS2_DISTORTION_MODIFIED_BROWN_CONRADY\"", "2", "1"}) {
    const Camera camera = load_one("rs.json", json(model));
    expect_pinhole(camera);
    EXPECT_EQ(camera.lens, LensModel::ModifiedBrownConrady) << model;
    EXPECT_EQ(camera.distortion, (LensCoefficients{-0.05, 0.06, 0.001, 0.002, -0.02})) << model;
  }
  EXPECT_EQ(load_one("rs.json", json("4")).lens, LensModel::BrownConrady);
  expect_input_error([&] { load_one("rs.json", json("0")); }, {"coeffs", "not 0", "model"});
  expect_input_error([&] { load_one("rs.json", json("9")); }, {"model", "9", "rs2_distortion"});
}

const std::string realsense_list = R"(Device info:
    Name                          : 	Intel RealSense D405
 Intrinsic of "Color" / 640x480 / {YUYV/RGB8}
  Width:      	640
  Height:     	480
  PPX:        	321
  PPY:        	238
  Fx:         	700
  Fy:         	701
  Distortion: 	Inverse Brown Conrady
  Coeffs:     	0  	0  	0  	0  	0
  FOV (deg):  	49.1 x 37.8

 Intrinsic of "Color" / 1280x960 / {YUYV/RGB8}
  Width:      	1280
  Height:     	960
  PPX:        	642
  PPY:        	476
  Fx:         	1400
  Fy:         	1402
  Distortion: 	Inverse Brown Conrady
  Coeffs:     	0  	0  	0  	0  	0
  FOV (deg):  	49.1 x 37.8

 Intrinsic of "Infrared 1" / 640x480 / {Y8}
  Width:      	640
  Height:     	480
  PPX:        	320
  PPY:        	240
  Fx:         	390
  Fy:         	390
  Distortion: 	Brown Conrady
  Coeffs:     	0  	0  	0  	0  	0

Motion Intrinsic Parameters:
Extrinsic from "Depth"	  To	  "Color" :
 Rotation Matrix:
   1 0 0
)";

TEST(CameraFormats, ChoosesAmongStreamsByNameAndSize) {
  const std::vector<FileCamera> cameras = load_text("rs.txt", realsense_list);
  ASSERT_EQ(cameras.size(), 3u);
  const auto small = [] { return SizePx(640, 480); };
  expect_pinhole(choose_camera(cameras, "Color", small, "rs.txt"));
  EXPECT_EQ(choose_camera(
                cameras, "Color", [] { return SizePx(1280, 960); }, "rs.txt")
                .fx,
            1400);
  expect_input_error([&] { choose_camera(cameras, "", small, "rs.txt"); },
                     {"rs.txt", "Color (640x480)", "Infrared 1", "--camera-name"});
  expect_input_error([&] { choose_camera(cameras, "Depth", small, "rs.txt"); },
                     {"rs.txt", "Color (640x480)", "one named Depth"});
  expect_input_error(
      [&] {
        choose_camera(
            cameras, "Color", [] { return SizePx(800, 600); }, "rs.txt");
      },
      {"rs.txt", "1280x960", "800x600"});
}

// The factory calibration of a colour camera and what the SDK gives for 1080p.
TEST(CameraFormats, ReadsAzureKinectForTheSizeOfTheImage) {
  const std::string json = R"({"CalibrationInformation": {"Cameras": [
 {"Intrinsics": {"ModelParameterCount": 14, "ModelParameters": [0.5122697949409485,
  0.49451231956481934, 0.4921168386936188, 0.4921667277812958, 3.13, 2.32, 0.13, 3.46, 3.35, 0.66,
  0, 0, -0.0000511557373101823, 0.00008132171933539212],
  "ModelType": "CALIBRATION_LensDistortionModelBrownConrady"},
  "Location": "CALIBRATION_CameraLocationD0", "SensorHeight": 1024, "SensorWidth": 1024},
 {"Intrinsics": {"ModelParameterCount": 14, "ModelParameters": [0.4967627227306366,
  0.5108628273010254, 0.470907062292099, 0.6274453997612, 0.72, -2.88, 1.63, 0.6, -2.7, 1.56, 0, 0,
  -0.0001431911950930953, 0.0007828465895727277],
  "ModelType": "CALIBRATION_LensDistortionModelBrownConrady"},
  "Location": "CALIBRATION_CameraLocationPV0", "SensorHeight": 3072, "SensorWidth": 4096}]}})";
  const std::vector<FileCamera> cameras = load_text("k4a.json", json);
  const Camera full_hd = choose_camera(
      cameras, "", [] { return SizePx(1920, 1080); }, "k4a.json");
  EXPECT_NEAR(full_hd.cx, 953.284424, 1e-5);
  EXPECT_NEAR(full_hd.cy, 555.142456, 1e-3);
  EXPECT_NEAR(full_hd.fx, 904.141541, 1e-3);
  EXPECT_NEAR(full_hd.fy, 903.521362, 1e-3);
  EXPECT_EQ(full_hd.distortion, (LensCoefficients{0.72, -2.88, 0.0007828465895727277,
                                                  -0.0001431911950930953, 1.63, 0.6, -2.7, 1.56}));
  const Camera depth = choose_camera(
      cameras, "", [] { return SizePx(640, 576); }, "k4a.json");
  EXPECT_NEAR(depth.cx, 332.064270, 1e-4);
  EXPECT_NEAR(depth.cy, 325.880615, 1e-4);
}

TEST(CameraFormats, ReadsColmapsOtherModels) {
  const auto camera = [](const std::string& line) { return load_one("cameras.txt", line); };
  const Camera simple = camera("1 SIMPLE_RADIAL 640 480 700 320 240 -0.1\n");
  EXPECT_EQ(simple.fy, 700);
  EXPECT_EQ(simple.cx, 319.5);
  EXPECT_EQ(simple.distortion[0], -0.1);
  EXPECT_EQ(camera("1 RADIAL 640 480 700 320 240 -0.1 0.2\n").distortion[1], 0.2);
  EXPECT_EQ(camera("1 SIMPLE_PINHOLE 640 480 700 320 240\n").fx, 700);
  EXPECT_EQ(camera("1 RADIAL_FISHEYE 640 480 700 320 240 -0.1 0.2\n").lens, LensModel::Fisheye);
  const Camera fov = camera("1 FOV 640 480 700 701 320 240 0.9\n");
  EXPECT_EQ(fov.lens, LensModel::FieldOfView);
  EXPECT_EQ(fov.distortion[0], 0.9);
  const Camera prism =
      camera("1 THIN_PRISM_FISHEYE 640 480 700 701 320 240 0.1 0.2 0.3 0.4 0.5 0.6 0.7 0.8\n");
  EXPECT_EQ(prism.lens, LensModel::ThinPrismFisheye);
  EXPECT_EQ(prism.distortion[7], 0.8);
  expect_input_error([&] { camera("1 DIVISION 640 480 700 701 320 240 0.9\n"); },
                     {"cameras.txt", "model", "DIVISION", "THIN_PRISM_FISHEYE"});
  expect_input_error([&] { camera("1 OPENCV 640 480 700 701 320 240 0.9\n"); },
                     {"params", "5 parameters", "8"});
}

TEST(CameraFormats, ReadsBopFisheye624) {
  const Camera camera = load_one("scene_camera.json", R"({"0": {"cam_model": {"image_width": 1408,
 "image_height": 1408, "projection_model_type": "CameraModelType.FISHEYE624", "serial_number": "1",
 "projection_params": [609, 704, 705, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12]}}})");
  EXPECT_EQ(camera.fx, 609);
  EXPECT_EQ(camera.fy, 609);
  EXPECT_EQ(camera.cx, 704);
  EXPECT_EQ(camera.cy, 705);
  EXPECT_EQ(camera.lens, LensModel::Fisheye);
  EXPECT_EQ(camera.distortion, (LensCoefficients{1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12}));
}

TEST(CameraFormats, ReadsThinPrismAndTilt) {
  const std::string head =
      "image_width: 640\nimage_height: 480\nK: [700, 0, 321, 0, 701, 238, 0, 0, 1]\n";
  for (const std::size_t count : {8, 12, 14}) {
    std::string text = head + "D: [";
    LensCoefficients expected{};
    for (std::size_t i = 0; i < count; ++i) {
      expected[i] = double(i + 1) / 64;
      text += (i == 0 ? "" : ", ") + std::to_string(expected[i]);
    }
    EXPECT_EQ(load_one("camera.yaml", text + "]\n").distortion, expected) << count;
  }
}

TEST(CameraFormats, ChoosesOneOfSeveralByName) {
  const std::string chain = R"(cam0:
  camera_model: pinhole
  distortion_coeffs: [0.1, 0, 0, 0]
  distortion_model: radtan
  intrinsics: [700, 701, 321, 238]
  resolution: [640, 480]
cam1:
  T_cn_cnm1: [[1, 0, 0, 0.1], [0, 1, 0, 0], [0, 0, 1, 0], [0, 0, 0, 1]]
  camera_model: pinhole
  distortion_coeffs: [0.2, 0, 0, 0]
  distortion_model: equidistant
  intrinsics: [800, 801, 319, 241]
  resolution: [640, 480]
)";
  expect_input_error([&] { load_one("camchain.yaml", chain); },
                     {"camchain.yaml", "cam0", "cam1", "--camera-name"});
  EXPECT_EQ(load_one("camchain.yaml", chain, "cam1").fx, 800);
  const std::vector<FileCamera> sizeless = load_text(
      "c.yaml", "a: {K: [5, 0, 3, 0, 6, 4, 0, 0, 1]}\nb: {K: [7, 0, 3, 0, 6, 4, 0, 0, 1]}\n");
  expect_input_error(
      [&] {
        choose_camera(
            sizeless, "", [] { return SizePx(6, 8); }, "c.yaml");
      },
      {"c.yaml", "a, b", "--camera-name"});
  const std::string stereo = R"(%YAML:1.0
---
M1: !!opencv-matrix
   rows: 3
   cols: 3
   dt: d
   data: [ 700., 0., 321., 0., 701., 238., 0., 0., 1. ]
D1: !!opencv-matrix
   rows: 1
   cols: 5
   dt: d
   data: [ -0.25, 0.12, 0.001, -0.0005, 0. ]
M2: !!opencv-matrix
   rows: 3
   cols: 3
   dt: d
   data: [ 800., 0., 319., 0., 801., 241., 0., 0., 1. ]
D2: !!opencv-matrix
   rows: 1
   cols: 5
   dt: d
   data: [ 0.1, 0., 0., 0., 0. ]
)";
  const Camera first = load_one("intrinsics.yml", stereo, "1");
  EXPECT_EQ(first.fx, 700);
  EXPECT_EQ(first.distortion[0], -0.25);
  EXPECT_EQ(load_one("intrinsics.yml", stereo, "2").distortion[0], 0.1);
  expect_input_error([&] { load_one("intrinsics.yml", stereo); }, {"1", "2", "--camera-name"});
}

// What a file says of the lens or of a part of the image is read or refused.
TEST(CameraFormats, RefusesWhatItDoesNotUnderstand) {
  const std::string head =
      "image_width: 640\nimage_height: 480\nK: [700, 0, 321, 0, 701, 238, 0, 0, 1]\n";
  const auto refused = [&](const std::string& more, std::initializer_list<std::string> words) {
    expect_input_error([&] { load_one("camera.yaml", head + more); }, words);
  };
  refused("lens_correction: [0.1, 0.2]\n", {"camera.yaml", "lens_correction", "found", "expected"});
  refused("crop: [10, 20, 300, 200]\n", {"crop"});
  refused("roi: [10, 20, 300, 200]\n", {"roi", "x_offset"});
  refused("roi: {x_offset: 10, y_offset: 0, zoom: 2}\n", {"roi/zoom"});
  refused("roi: {x_offset: 10, y_offset: 0}\n", {"roi", "offset without a size"});
  refused("camera_model: omni\nD: [0.1, 0, 0, 0]\n", {"camera_model", "omni", "kannala_brandt"});
  refused("binning: 2\n", {"binning"});
  refused("camera_model: ds\nxi: 0.5\n", {"camera_model", "ds"});
  refused("xi: 0.5\n", {"xi"});
  refused("k7: 0.5\n", {"k7"});
  refused("distortion_model: division\nD: [0.1]\n", {"distortion_model", "division"});
  refused("distortion_model: none\nD: [0.1, 0, 0, 0]\n", {"D", "distortion_model"});
  refused("fisheye: true\nD: [0.1, 0, 0, 0, 0.3]\n", {"D", "5 coefficients", "4"});
  refused("D: [0.1, 0.2, 0.3]\n", {"D", "3 coefficients", "4, 5, 8, 12, 14"});
  refused("D: [0.1, 0.2, 0, 0]\nk1: 0.3\n", {"k1", "D"});
  refused("camera_matrix: [[650, 0, 321], [0, 701, 238], [0, 0, 1]]\n", {"fx", "650", "700"});
  refused("image_width: 800\n", {"image_width", "twice"});
  refused("width: 800\n", {"width", "800", "640"});
  for (const char* harmless :
       {"roi: {x_offset: 0, y_offset: 0, width: 0, height: 0}\n", "crop: null\n", "skew: 0\n",
        "binning: 1\n", "distortion_model: ''\nD: []\n", "lens_distortion: none\n",
        "note: taken with the new lens\n"})
    expect_pinhole(load_one("camera.yaml", head + harmless));
}

TEST(CameraFormats, RefusesMatricesThatAreNone) {
  const auto refused = [](const std::string& text, std::initializer_list<std::string> words) {
    expect_input_error([&] { load_one("camera.yaml", text); }, words);
  };
  refused("K: [700, 0, 0, 0, 701, 0, 321, 238, 1]\n", {"K", "transposed", "fx 0 cx"});
  refused("K: [0, 0, 0, 0, 0, 0, 0, 0, 0]\n", {"K", "only zeros", "calibrated"});
  refused("K: [700, 0, 321, 0, 701, 238, 0, 0, 2]\n", {"K", "fx 0 cx"});
  refused("K: [700, 701, 321]\n", {"K", "3 numbers"});
  refused("fx: 700\nfy: 701\ncx: 321\n", {"cy", "nothing"});
  EXPECT_EQ(load_one("camera.yaml", "K: [700, 1.5, 321, 0, 701, 238, 0, 0, 1]\n").skew, 1.5);
}

TEST(CameraFormats, SyntaxErrorsAreOneLine) {
  for (const auto& [file, text] : std::vector<std::pair<std::string, std::string>>{
           {"c.xml", "<a><b>1</a>"},
           {"c.xml", "<a"},
           {"c.xml", "<a x=1/>"},
           {"c.xml", "<?xml version=\"1.0\"?>"},
           {"c.xml", "<a></a>"},
           {"c.json", "{\"fx\": 1,"},
           {"c.json", "{\"fx\": 1, \"fx\": 2}"},
           {"c.yaml", "fx: [1, 2"},
           {"c.yaml", "fx: 700\n  fy: 701\n"},
           {"c.yaml", ""},
           {"c.mat", std::string("MATLAB 5.0\0\x01", 12)},
           {"c.txt", "1 2 3\n"},
           {"c.txt", "just words\n"},
           {"c.ini", "[a]\nfx=1\nfx=2\n"}})
    expect_input_error([&, file = file, text = text] { load_one(file, text); },
                       {file, "found", "expected"});
}

TEST(CameraFormats, ReadsUtf16OfWindowsShells) {
  const std::string text =
      "K: [700, 0, 321, 0, 701, 238, 0, 0, 1]\r\nwidth: 640\r\nheight: 480\r\n";
  std::string wide = "\xff\xfe";
  for (const char c : text) {
    wide += c;
    wide += '\0';
  }
  expect_pinhole(load_one("camera.yaml", wide));
}

}  // namespace
}  // namespace edgescout::test
