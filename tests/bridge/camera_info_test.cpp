#include "host/bridge/ros2/camera_info.h"

#include <gtest/gtest.h>

#include "host/core/lens.h"
#include "host/io/camera_file.h"
#include "tests/bridge/small_world.h"
#include "tests/io/expect_input_error.h"

namespace edgescout::ros2::test {

namespace {

using edgescout::test::expect_input_error;

Camera sensor() { return {640, 480, 700, 710, 320, 240, {}}; }

Camera read(const msg::CameraInfo& info, bool rectified = false) {
  return camera_of(info, rectified, "camera_info");
}

TEST(CameraInfo, IsReadAsACalibrationFile) {
  msg::CameraInfo info = info_message(sensor());
  info.d = {-0.3, 0.1, 0.001, -0.002, 0.01};
  const Camera of_file =
      cameras_in(
          "image_width: 640\nimage_height: 480\ndistortion_model: plumb_bob\n"
          "camera_matrix: {rows: 3, cols: 3, data: [700, 0, 320, 0, 710, 240, 0, 0, 1]}\n"
          "distortion_coefficients: {rows: 1, cols: 5, data: [-0.3, 0.1, 0.001, -0.002, 0.01]}\n",
          "file")[0]
          .camera;
  EXPECT_TRUE(same_camera(read(info), of_file));
}

TEST(CameraInfo, KnowsTheModelsOfRos) {
  msg::CameraInfo info = info_message(sensor());
  info.distortion_model = "equidistant";
  info.d = {0.01, -0.02, 0.003, -0.0004};
  EXPECT_EQ(read(info).lens, LensModel::Fisheye);
  EXPECT_EQ(read(info).distortion[1], -0.02);
  info.distortion_model = "rational_polynomial";
  info.d = {0.1, 0.2, 0.001, 0.002, 0.3, 0.4, 0.5, 0.6};
  EXPECT_EQ(read(info).lens, LensModel::BrownConrady);
  EXPECT_EQ(read(info).distortion[7], 0.6);
  info.distortion_model = "";
  info.d = {};
  EXPECT_FALSE(read(info).has_distortion());
}

TEST(CameraInfo, AppliesRegionAndBinning) {
  msg::CameraInfo info = info_message(sensor());
  info.roi = {100, 40, 200, 300, false};
  Camera camera = read(info);
  EXPECT_EQ(camera.width, 300);
  EXPECT_EQ(camera.height, 200);
  EXPECT_EQ(camera.cx, 220);
  EXPECT_EQ(camera.cy, 200);
  info.binning_x = info.binning_y = 2;
  camera = read(info);
  EXPECT_EQ(camera.width, 150);
  EXPECT_EQ(camera.fx, 350);
  EXPECT_EQ(camera.cx, 220.5 / 2 - 0.5);
}

TEST(CameraInfo, RectifiedImagesHaveP) {
  msg::CameraInfo info = info_message(sensor());
  info.d = {-0.3, 0.1, 0.001, -0.002, 0.01};
  info.p = {600, 0, 300, -60, 0, 610, 250, 0, 0, 0, 1, 0};
  const Camera camera = read(info, true);
  EXPECT_FALSE(camera.has_distortion());
  EXPECT_EQ(camera.fx, 600);
  EXPECT_EQ(camera.cy, 250);
}

TEST(CameraInfo, RefusesWhatIsNoCamera) {
  msg::CameraInfo info = info_message(sensor());
  info.k = {};
  expect_input_error([&] { read(info); }, {"camera_info: k: found zeros", "uncalibrated"});
  info = info_message(sensor());
  info.p = {};
  expect_input_error([&] { read(info, true); }, {"camera_info: p: found zeros"});
  EXPECT_NO_THROW(read(info));
  info.d[2] = NAN;
  expect_input_error([&] { read(info); }, {"camera_info: d: found", "finite"});
  info = info_message(sensor());
  info.k[4] = INFINITY;
  expect_input_error([&] { read(info); }, {"camera_info: k", "finite"});
  info = info_message(sensor());
  info.d.assign(1000, 0.0);
  expect_input_error([&] { read(info); }, {"camera_info: d: found 1000 numbers"});
  info = info_message(sensor());
  info.distortion_model = "a model\nof two lines";
  info.d[0] = 0.1;
  expect_input_error([&] { read(info); }, {"camera_info"});
  info = info_message(sensor());
  info.binning_x = 1000;
  expect_input_error([&] { read(info); }, {"binning"});
  info = info_message(sensor());
  info.roi = {0xffffffff, 5, 10, 10, false};
  EXPECT_THROW(read(info), InputError);
}

TEST(CameraInfo, ThatOfTheImagesTimeIsChosen) {
  CameraInfos infos;
  EXPECT_EQ(infos.for_image(header_at(1)), nullptr);
  for (int i = 1; i <= 20; ++i) {
    msg::CameraInfo info = info_message(sensor(), i);
    info.width = std::uint32_t(600 + i);
    infos.add(info);
  }
  EXPECT_EQ(infos.for_image(header_at(18))->width, 618u);
  EXPECT_EQ(infos.for_image(header_at(18.5))->width, 620u);
  EXPECT_EQ(infos.for_image(header_at(2))->width, 620u);  // too long ago
}

}  // namespace

}  // namespace edgescout::ros2::test
