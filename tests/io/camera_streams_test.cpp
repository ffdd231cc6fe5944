// Files of several cameras or of one at several sizes.
#include "tests/io/camera_sample.h"
#include "tests/io/expect_input_error.h"

namespace edgescout::test {
namespace {

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
                     {"rs.txt", "Color (640x480)", "Infrared 1", "camera_name"});
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
                     {"camchain.yaml", "cam0", "cam1", "camera_name"});
  EXPECT_EQ(load_one("camchain.yaml", chain, "cam1").fx, 800);
  const std::vector<FileCamera> sizeless = load_text(
      "c.yaml", "a: {K: [5, 0, 3, 0, 6, 4, 0, 0, 1]}\nb: {K: [7, 0, 3, 0, 6, 4, 0, 0, 1]}\n");
  expect_input_error(
      [&] {
        choose_camera(
            sizeless, "", [] { return SizePx(6, 8); }, "c.yaml");
      },
      {"c.yaml", "a, b", "camera_name"});
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
  expect_input_error([&] { load_one("intrinsics.yml", stereo); }, {"1", "2", "camera_name"});
}

// Several cameras as fields side by side.
TEST(CameraFormats, SplitsCamerasThatShareAnObject) {
  const auto expect = [](const std::string& text, const std::string& name,
                         const std::string& other) {
    const Camera camera = load_one("cameras.txt", text, name);
    EXPECT_EQ(camera.fx, 700) << text;
    EXPECT_EQ(camera.distortion[0], -0.25) << text;
    EXPECT_EQ(load_one("cameras.txt", text, other).fx, 500) << text;
    expect_input_error([&] { load_one("cameras.txt", text); }, {name, other, "camera_name"});
  };
  expect(
      "[ColorIntrinsic]\nfx=700\nfy=701\ncx=321\ncy=238\n[DepthIntrinsic]\nfx=500\nfy=500\n"
      "cx=320\ncy=240\n[ColorDistortion]\nk1=-0.25\n[DepthDistortion]\nk1=0\n",
      "color", "depth");
  expect(R"({"rgb_intrinsics": {"fx": 700, "fy": 701, "ppx": 321, "ppy": 238,
 "coeffs": [-0.25, 0, 0, 0, 0]}, "depth_intrinsics": {"fx": 500, "fy": 500, "ppx": 321, "ppy": 238,
 "coeffs": [0, 0, 0, 0, 0]}})",
         "rgb", "depth");
  expect(
      "K_00: 700 0 321 0 701 238 0 0 1\nD_00: -0.25 0.12 0.001 -0.0005 0\ncorner_dist: 0.1\n"
      "K_01: 500 0 321 0 701 238 0 0 1\nD_01: -0.3 0.12 0.001 -0.0005 0\n",
      "00", "01");
  expect(
      "cam0_K: [700, 0, 321, 0, 701, 238, 0, 0, 1]\ncam0_D: [-0.25, 0, 0, 0]\n"
      "cam1_K: [500, 0, 321, 0, 701, 238, 0, 0, 1]\ncam1_D: [0, 0, 0, 0]\n",
      "cam0", "cam1");
  expect(
      "%YAML:1.0\nCamera.type: PinHole\nCamera1.fx: 700\nCamera1.fy: 701\nCamera1.cx: 321\n"
      "Camera1.cy: 238\nCamera1.k1: -0.25\nCamera2.fx: 500\nCamera2.fy: 500\nCamera2.cx: 321\n"
      "Camera2.cy: 238\nCamera2.k1: -0.2\nCamera.width: 640\nCamera.height: 480\n",
      "camera1", "camera2");
  expect(
      "%YAML:1.0\nCamera.fx: 500\nCamera.fy: 500\nCamera.cx: 367\nCamera.cy: 252\n"
      "LEFT.K: [700, 0, 321, 0, 701, 238, 0, 0, 1]\nLEFT.D: [-0.25, 0.12, 0, 0, 0]\n"
      "RIGHT.K: [710, 0, 321, 0, 701, 238, 0, 0, 1]\nRIGHT.D: [-0.2, 0.12, 0, 0, 0]\n",
      "left", "main");
  expect(
      "[LEFT_CAM_VGA]\nfx=700\nfy=701\ncx=321\ncy=238\n[RIGHT_CAM_VGA]\nfx=500\nfy=500\n"
      "cx=321\ncy=238\n[LEFT_DISTO]\nk1=-0.25\n[RIGHT_DISTO]\nk1=-0.3\n[STEREO]\nBaseline=63\n",
      "LEFT_CAM_VGA", "RIGHT_CAM_VGA");
}

// Lenses that stand beside the cameras and belong to none.
TEST(CameraFormats, RefusesALensBesideTheCameras) {
  expect_input_error(
      [] {
        load_text("c.json", R"({"a": {"fx": 700, "fy": 701, "cx": 321, "cy": 238},
 "calibration_of_a": {"k1": -0.25}, "b": {"fx": 500, "fy": 500, "cx": 320, "cy": 240}})");
      },
      {"calibration_of_a/k1", "-0.25", "looks like a lens"});
  expect_input_error(
      [] {
        load_one("c.json",
                 R"({"fx": 700, "fy": 701, "cx": 321, "cy": 238, "result": {"k1": -0.25}})");
      },
      {"result/k1", "-0.25", "looks like a lens"});
  const std::string camera = "{fx: 700, fy: 701, cx: 321, cy: 238}";
  for (const char* lens : {"{D: [-0.25, 0.12, 0, 0]}", "{k1: -0.25}"}) {
    expect_input_error([&] { load_text("c.yaml", "[" + camera + ", " + lens + "]"); },
                       {"1/", "looks like a lens"});
    expect_input_error([&] { load_text("c.yaml", camera + "\n---\n" + lens); },
                       {"1/", "looks like a lens"});
  }
  load_one("c.json", R"({"fx": 700, "fy": 701, "cx": 321, "cy": 238,
 "extrinsics": {"rotation": 90}, "infrared_camera": {"fx": 5, "fy": 5, "cx": 3, "cy": 3, "k1": 1}})");
}

}  // namespace
}  // namespace edgescout::test
