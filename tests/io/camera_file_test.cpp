#include "host/io/camera_file.h"

#include <gtest/gtest.h>

#include "tests/io/expect_input_error.h"
#include "tests/io/temporary_folder.h"

namespace edgescout::test {
namespace {

const std::string ros = R"(image_width: 640
image_height: 480
camera_name: head
camera_matrix:
  rows: 3
  cols: 3
  data: [600.5, 0, 319.25, 0, 601.5, 241, 0, 0, 1]
distortion_model: plumb_bob
distortion_coefficients:
  rows: 1
  cols: 5
  data: [0.1, -0.2, 0.001, 0.002, 0.03]
rectification_matrix: {rows: 3, cols: 3, data: [1, 0, 0, 0, 1, 0, 0, 0, 1]}
)";

const std::string opencv = R"(%YAML:1.0
---
image_width: 640
image_height: 480
cameraMatrix: !!opencv-matrix
   rows: 3
   cols: 3
   dt: d
   data: [ 600.5, 0., 319.25, 0., 601.5, 241., 0., 0., 1. ]
dist_coeffs: !!opencv-matrix
   rows: 5
   cols: 1
   dt: d
   data: [ 1.0e-01, -2.0e-01, 1.0e-03, 2.0e-03,
       3.0e-02 ]
)";

const std::string bop =
    R"({"fx": 600.5, "fy": 601.5, "cx": 319.25, "cy": 241, "width": 640, "height": 480,
 "dist": [0.1, -0.2, 0.001, 0.002, 0.03], "depth_scale": 0.1})";

std::string replaced(std::string text, const std::string& what, const std::string& by) {
  EXPECT_NE(text.find(what), std::string::npos) << what;
  return text.replace(text.find(what), what.size(), by);
}

Camera load(const std::string& text, const std::string& name = "camera.yaml") {
  const TemporaryFolder folder;
  return load_camera(folder.write(name, text));
}

TEST(LoadCamera, ReadsTheSameCameraFromEveryForm) {
  for (const Camera& c : {load(ros), load(opencv), load(bop, "camera.json")}) {
    EXPECT_EQ(c.width, 640);
    EXPECT_EQ(c.height, 480);
    EXPECT_EQ(c.fx, 600.5);
    EXPECT_EQ(c.fy, 601.5);
    EXPECT_EQ(c.cx, 319.25);
    EXPECT_EQ(c.cy, 241);
    EXPECT_EQ(c.distortion, (LensCoefficients{0.1, -0.2, 0.001, 0.002, 0.03}));
  }
}

TEST(LoadCamera, ReadsPlainMatricesAndTheRationalModel) {
  const Camera c = load(
      "K: [[5, 0, 3], [0, 6, 4], [0, 0, 1]]\nD: [1, 2, 3, 4, 5, 6, 7, 8]\nimage_width: "
      "8\nimage_height: 9\n");
  EXPECT_EQ(c.fy, 6);
  EXPECT_EQ(c.distortion, (LensCoefficients{1, 2, 3, 4, 5, 6, 7, 8}));
  const std::string rational =
      replaced(replaced(ros, "plumb_bob", "rational_polynomial"), "0.03]", "0.03, 4, 5, 6]");
  EXPECT_EQ(load(rational).distortion[7], 6);
}

TEST(LoadCamera, ReadsASceneCameraWhoseImagesAgree) {
  const std::string same =
      R"({"1": {"cam_K": [5, 0, 3, 0, 6, 4, 0, 0, 1]}, "7": {"cam_K": [5, 0, 3, 0, 6, 4, 0, 0, 1]}})";
  const Camera c = load(same, "scene_camera.json");
  EXPECT_EQ(c.fx, 5);
  EXPECT_EQ(c.width, 0);
  expect_input_error(
      [&] {
        load(replaced(same, "\"7\": {\"cam_K\": [5", "\"7\": {\"cam_K\": [9"), "scene_camera.json");
      },
      {"scene_camera.json", "1, 7", "one camera"});
  const Camera alone =
      load(R"({"cam_K": [5, 0, 3, 0, 6, 4, 0, 0, 1], "depth_scale": 1})", "camera.json");
  EXPECT_EQ(alone.fy, 6) << "one entry by itself";
}

TEST(LoadCamera, NamesFileAndFieldOfWhatIsMissing) {
  expect_input_error([] { load(replaced(ros, "camera_matrix", "numbers")); },
                     {"camera.yaml", "camera_matrix", "the distortion alone"});
  expect_input_error([] { load(replaced(ros, "image_height: 480", "")); },
                     {"camera.yaml", "image_height", "nothing"});
  expect_input_error([] { load(replaced(ros, "distortion_coefficients", "numbers")); },
                     {"distortion_coefficients", "nothing"});
  expect_input_error([] { load(replaced(ros, "600.5, ", "")); }, {"camera_matrix", "8 numbers"});
  expect_input_error(
      [] {
        load(replaced(ros, ", 0.03]", "]"));
        load(replaced(ros, "0.002, 0.03]", "]"));
      },
      {"distortion_coefficients", "3 coefficients"});
  expect_input_error([] { load(replaced(bop, "\"fy\": 601.5, ", ""), "camera.json"); },
                     {"camera.json", "fy", "nothing"});
  for (const char* other : {"{}", "[600, 600]", "{\"a\": {\"b\": 1}}", "\"text\""})
    expect_input_error([&] { load(other, "camera.json"); },
                       {"camera.json", "camera_matrix", "fx, fy, cx and cy"});
  expect_input_error([] { load("", "camera.yaml"); }, {"camera.yaml"});
  expect_input_error([] { load("just text"); }, {"camera.yaml"});
  expect_input_error([] { load("a: [1, 2"); }, {"camera.yaml", "YAML"});
  expect_input_error([] { load("{\"fx\": ", "camera.json"); }, {"camera.json", "JSON"});
  expect_input_error([] { load_camera("no-such-camera.yaml"); },
                     {"no-such-camera.yaml", "No such file"});
}

TEST(LoadCamera, RejectsValuesThatAreNotFiniteOrNegative) {
  for (const char* bad : {".nan", ".inf", "-.inf", "nan", "abc"}) {
    expect_input_error([&] { load(replaced(ros, "600.5", bad)); },
                       {"camera.yaml", "camera_matrix"});
    expect_input_error([&] { load(replaced(ros, "-0.2", bad)); },
                       {"camera.yaml", "distortion_coefficients"});
  }
  expect_input_error([] { load(replaced(ros, "600.5", "-600.5")); },
                     {"camera.yaml", "fx", "-600.5", "positive"});
  expect_input_error([] { load(replaced(ros, "601.5", "0")); }, {"camera.yaml", "fy", "positive"});
  expect_input_error([] { load(replaced(bop, "600.5", "-1"), "camera.json"); },
                     {"camera.json", "fx", "positive"});
  expect_input_error([] { load(replaced(bop, "600.5", "null"), "camera.json"); },
                     {"camera.json", "fx", "nothing"});
  expect_input_error([] { load(replaced(bop, "600.5", "1e999"), "camera.json"); }, {"camera.json"});
  expect_input_error([] { load(replaced(ros, "319.25", "319250")); }, {"camera.yaml", "cx"});
  expect_input_error([] { load(replaced(ros, "image_width: 640", "image_width: -640")); },
                     {"camera.yaml", "width", "-640"});
  expect_input_error([] { load(replaced(ros, "image_width: 640", "image_width: wide")); },
                     {"camera.yaml", "image_width"});
}

TEST(LoadCamera, RejectsAListThatHoldsItself) {
  expect_input_error([] { load("camera_matrix: &a [1, *a]\n"); },
                     {"camera.yaml", "lists without an end"});
  expect_input_error([] { load("K: [5, 0, 3, 0, 6, 4, 0, 0, 1]\nD: {data: &a [[*a]]}\n"); },
                     {"camera.yaml", "lists without an end"});
}

TEST(LoadCamera, RejectsModelsItCannotUndo) {
  expect_input_error([] { load(replaced(ros, "plumb_bob", "omnidirectional")); },
                     {"distortion_model", "omnidirectional", "plumb_bob"});
  expect_input_error([] { load(replaced(ros, "plumb_bob", "equidistant")); },
                     {"distortion_coefficients", "5 coefficients", "4"});
  expect_input_error([] { load(replaced(ros, "0.03]", "0.03, 0, 0, 0, 0.1]")); },
                     {"distortion_coefficients", "9 coefficients", "12"});
}

const Camera calibration{640, 480, 600, 610, 319.5, 239.5, {}};

TEST(CameraForImage, PassesTheCalibrationsOwnSize) {
  const Camera c = camera_for_image(calibration, 640, 480, false, "x");
  EXPECT_EQ(c.fx, 600);
  EXPECT_EQ(c.cx, 319.5);
}

TEST(CameraForImage, ScalesOnlyWhereAllowedAndPure) {
  const Camera half = camera_for_image(calibration, 320, 240, true, "x");
  EXPECT_EQ(half.width, 320);
  EXPECT_DOUBLE_EQ(half.fx, 300);
  EXPECT_DOUBLE_EQ(half.fy, 305);
  // Pixel centres at integers: the image's centre stays its centre.
  EXPECT_DOUBLE_EQ(half.cx, 159.5);
  EXPECT_DOUBLE_EQ(half.cy, 119.5);
  EXPECT_EQ(camera_for_image(calibration, 213, 160, true, "x").width, 213);  // a third, rounded
  expect_input_error([] { camera_for_image(calibration, 320, 240, false, "k.yaml"); },
                     {"k.yaml", "image size", "320x240", "640x480", "scale_camera"});
  for (bool allowed : {false, true})
    expect_input_error([&] { camera_for_image(calibration, 640, 400, allowed, "k.yaml"); },
                       {"k.yaml", "640x400", "640x480"});
}

TEST(CameraForImage, TakesTheImagesSizeWhereTheCalibrationHasNone) {
  Camera sizeless = calibration;
  sizeless.width = sizeless.height = 0;
  EXPECT_EQ(camera_for_image(sizeless, 640, 480, false, "x").height, 480);
  expect_input_error([&] { camera_for_image(sizeless, 100, 80, false, "k.json"); },
                     {"k.json", "cx", "principal point"});
}

// Found by fuzzing: the YAML library found documents without an end here until the memory ended.
TEST(LoadCameras, RefusesYamlWithoutAnEnd) {
  const TemporaryFolder folder;
  for (const char* text : {",", "a: 1\n---\n,b: 2", ",ri/t4/.inrfx  2,16"})
    expect_input_error([&] { load_cameras(folder.write("a.yaml", text)); },
                       {"a.yaml", "YAML", "without an end"});
}

// OpenCV's calibration writes the points of all images.
TEST(LoadCameras, ReadsAFileOfManyPoints) {
  std::string points = "image_points: [ 1.0000000e+01";
  for (int i = 0; i < 120'000; ++i) points += ", 3.2100000e+02";
  const Camera camera = load(opencv + points + " ]\n");
  EXPECT_EQ(camera.fx, 600.5);
  std::string short_values = "a: [1";
  for (int i = 0; i < 250'000; ++i) short_values += ",1";
  expect_input_error([&] { load(short_values + "]\n"); },
                     {"camera.yaml", "YAML", "more than", "values"});
}

TEST(LoadCameras, NamesFieldsWithLineBreaksInOneLine) {
  const TemporaryFolder folder;
  expect_input_error(
      [&] {
        load_cameras(
            folder.write("a.json", R"({"ImageSize": [480, 640], "RadialDistortion": [-0.25, 0.12],
                          "T\ngentialDistortion": [0.001, -0.0005], "Skew": 0,
                          "IntrinsicMatrix": [[700, 0, 0], [0, 701, 0], [322, 239, 1]]})"));
      },
      {"a.json", "T gentialDistortion"});
}

}  // namespace
}  // namespace edgescout::test
