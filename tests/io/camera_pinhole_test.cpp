// The same camera without a lens as many programs write it.
#include "tests/io/camera_sample.h"

namespace edgescout::test {
namespace {

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
    {"below its name", "intrinsic.txt", "intrinsic\n700 0 321\n0 701 238\n0 0 1\n"},
    {"beside sensors that are no cameras", "calibrated_sensor.json",
     R"([{"token": "radar", "camera_intrinsic": []},
 {"token": "front", "camera_intrinsic": [[700, 0, 321], [0, 701, 238], [0, 0, 1]]}])"},
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

}  // namespace
}  // namespace edgescout::test
