// Lens models that few programs write.
#include "tests/io/camera_sample.h"
#include "tests/io/expect_input_error.h"

namespace edgescout::test {
namespace {

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

TEST(CameraFormats, ReadsOpenMvgsOrderOfCoefficients) {
  const Camera camera = load_one("sfm_data.json", R"({"intrinsics": [{"key": 0, "value":
 {"polymorphic_id": 1, "polymorphic_name": "pinhole_brown_t2", "ptr_wrapper": {"id": 1, "data":
 {"width": 640, "height": 480, "focal_length": 700, "principal_point": [321, 238],
  "disto_t2": [-0.25, 0.12, 0.01, 0.001, -0.0005]}}}}]})");
  EXPECT_EQ(camera.distortion, (LensCoefficients{-0.25, 0.12, 0.001, -0.0005, 0.01}));
}

TEST(CameraFormats, ReadsBouguetsSkew) {
  const Camera camera =
      load_one("camera.json", R"({"fc": [700, 701], "cc": [321, 238], "alpha_c": 0.01})");
  EXPECT_DOUBLE_EQ(camera.skew, 7);
}

TEST(CameraFormats, ReadsBothModelsOfVisp) {
  const std::string xml = R"(<?xml version="1.0"?>
<root><camera><name>Camera</name><image_width>640</image_width><image_height>480</image_height>
<model><type>perspectiveProjWithoutDistortion</type>
<px>690</px><py>691</py><u0>321</u0><v0>238</v0></model>
<model><type>perspectiveProjWithDistortion</type>
<px>700</px><py>701</py><u0>321</u0><v0>238</v0><kud>-0.25</kud><kdu>0.3</kdu></model>
</camera></root>)";
  expect_input_error([&] { load_one("camera.xml", xml); },
                     {"perspectiveProjWithDistortion", "camera_name"});
  const Camera lens = load_one("camera.xml", xml, "perspectiveProjWithDistortion");
  expect_pinhole(lens);
  EXPECT_EQ(lens.distortion, LensCoefficients{-0.25});
  EXPECT_EQ(load_one("camera.xml", xml, "perspectiveProjWithoutDistortion").fx, 690);
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

}  // namespace
}  // namespace edgescout::test
