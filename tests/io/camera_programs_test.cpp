// Calibrations of photogrammetry, odometry and vision programs that have units of their own: read,
// or refused in a line that names the program.
#include "tests/io/camera_sample.h"
#include "tests/io/expect_input_error.h"

namespace edgescout::test {
namespace {

std::string text_with(std::string text, const std::string& from, const std::string& to) {
  const std::size_t at = text.find(from);
  EXPECT_NE(at, std::string::npos) << from;
  return text.replace(at, from.size(), to);
}

void expect_lens(const Camera& camera, LensModel lens, const LensCoefficients& coefficients) {
  EXPECT_EQ(camera.lens, lens);
  EXPECT_EQ(camera.distortion, coefficients);
}

void expect_refused_text(const std::string& file, const std::string& text,
                         std::initializer_list<std::string> parts) {
  expect_input_error([&] { load_text(file, text); }, parts);
}

// --- OpenSfM

const std::string opensfm = R"({"v2 acme 640 480 brown 1.09": {
  "projection_type": "brown", "width": 640, "height": 480,
  "focal_x": 1.09375, "focal_y": 1.0953125, "c_x": 0.00234375, "c_y": -0.00234375,
  "k1": -0.25, "k2": 0.12, "p1": 0.001, "p2": -0.0005, "k3": 0.01}})";

TEST(CameraPrograms, ReadsOpenSfmInPartsOfTheLongerSide) {
  const Camera camera = load_one("camera_models.json", opensfm);
  expect_pinhole(camera);
  expect_lens(camera, LensModel::BrownConrady, {-0.25, 0.12, 0.001, -0.0005, 0.01});
  const Camera upright =
      load_one("camera_models.json", R"({"a": {"projection_type": "perspective", "width": 480,
      "height": 640, "focal": 1.09375, "k1": -0.25, "k2": 0.12}})");
  EXPECT_EQ(upright.fx, 700);
  EXPECT_EQ(upright.fy, 700);
  EXPECT_EQ(upright.cx, 239.5);
  EXPECT_EQ(upright.cy, 319.5);
  expect_lens(upright, LensModel::BrownConrady, {-0.25, 0.12});
}

TEST(CameraPrograms, ReadsFisheyeLensesOfOpenSfm) {
  const std::string two = R"({"a": {"projection_type": "fisheye", "width": 640, "height": 480,
      "focal": 0.5, "k1": 0.02, "k2": -0.01}})";
  expect_lens(load_one("camera_models.json", two), LensModel::Fisheye, {0.02, -0.01});
  const std::string four = R"({"a": {"projection_type": "fisheye_opencv", "width": 640,
      "height": 480, "focal_x": 0.5, "focal_y": 0.5, "c_x": 0, "c_y": 0, "k1": 0.02, "k2": -0.01,
      "k3": 0.003, "k4": -0.004}})";
  expect_lens(load_one("camera_models.json", four), LensModel::Fisheye,
              {0.02, -0.01, 0.003, -0.004});
  const std::string tangential =
      text_with(text_with(four, "fisheye_opencv", "fisheye62"), "\"k4\"", "\"p1\": 0.001, \"k4\"");
  expect_refused_text("camera_models.json", tangential, {"a/p1", "0.001", "OpenSfM", "fisheye62"});
}

TEST(CameraPrograms, ReadsAReconstructionOfOpenSfm) {
  const std::string text = "[{\"cameras\": " + opensfm +
                           R"(, "shots": {"1.jpg": {"rotation": [0.1, 0.2, 0.3],
      "translation": [0, 1, 2], "camera": "v2 acme 640 480 brown 1.09", "orientation": 6,
      "scale": 1.0}}, "points": {"1": {"color": [1, 2, 3], "coordinates": [1, 2, 3]}}}])";
  expect_pinhole(load_one("reconstruction.json", text));
  expect_pinhole(load_one("reconstruction.json", text, "v2 acme 640 480 brown 1.09"));
}

TEST(CameraPrograms, RefusesOtherModelsOfOpenSfm) {
  for (const char* type : {"spherical", "equirectangular", "dual"})
    expect_refused_text(
        "camera_models.json",
        std::string("{\"a\": {\"projection_type\": \"") + type +
            "\", \"width\": 640, \"height\": 480, \"focal\": 0.9}}",
        {"camera_models.json", "a/projection_type", "OpenSfM", type, "perspective"});
  expect_refused_text("camera_models.json", text_with(opensfm, "\"width\": 640,", ""),
                      {"camera_models.json", "width"});
  expect_refused_text("camera_models.json", text_with(opensfm, "0.00234375", "320"),
                      {"c_x", "320", "longer side"});
  expect_refused_text("camera_models.json", text_with(opensfm, "\"k3\"", "\"k4\": 0.1, \"k3\""),
                      {"camera_models.json", "k4"});
}

TEST(CameraPrograms, KeepsPixelsBesideAProjectionType) {
  const Camera camera = load_one("mine.json", R"({"projection_type": "perspective", "width": 640,
      "height": 480, "fx": 700, "fy": 701, "cx": 321, "cy": 238})");
  expect_pinhole(camera);
}

// --- AliceVision

const std::string meshroom = R"({"version": ["1", "2", "6"], "featuresFolders": ["features"],
  "views": [{"viewId": "12", "intrinsicId": "77", "path": "1.jpg", "width": "640",
             "height": "480", "metadata": {"Exif:FocalLength": "7", "Orientation": "6"}}],
  "intrinsics": [{"intrinsicId": "77", "width": "640", "height": "480", "sensorWidth": "6.4",
    "sensorHeight": "4.8", "serialNumber": "abc", "type": "brown",
    "initializationMode": "estimated", "initialFocalLength": "7.2", "focalLength": "7",
    "pixelRatio": "1", "pixelRatioLocked": "true", "scaleLocked": "false",
    "offsetLocked": "false", "distortionLocked": "false", "principalPoint": ["1", "-2"],
    "distortionInitializationMode": "none",
    "distortionParams": ["-0.25", "0.12", "0.01", "0.001", "-0.0005"],
    "undistortionOffset": ["0", "0"], "undistortionParams": "", "locked": "false"}],
  "poses": [{"poseId": "12", "pose": {"transform": {"rotation":
    ["1", "0", "0", "0", "1", "0", "0", "0", "1"], "center": ["0", "0", "0"]}}}]})";

TEST(CameraPrograms, ReadsAliceVisionInMm) {
  const Camera camera = load_one("cameras.sfm", meshroom);
  EXPECT_EQ(camera.width, 640);
  EXPECT_EQ(camera.height, 480);
  EXPECT_NEAR(camera.fx, 700, 1e-9);
  EXPECT_NEAR(camera.fy, 700, 1e-9);
  EXPECT_EQ(camera.cx, 321);
  EXPECT_EQ(camera.cy, 238);
  expect_lens(camera, LensModel::BrownConrady, {-0.25, 0.12, 0.001, -0.0005, 0.01});
  EXPECT_EQ(load_one("cameras.sfm", meshroom, "77").cx, 321);
  const std::string wide = text_with(meshroom, "\"pixelRatio\": \"1\"", "\"pixelRatio\": \"2\"");
  EXPECT_NEAR(load_one("cameras.sfm", wide).fy, 1400, 1e-9);
  EXPECT_NEAR(load_one("cameras.sfm", text_with(wide, "\"6\"]", "\"4\"]")).fy, 350, 1e-9);
}

TEST(CameraPrograms, ReadsTheLensesOfAliceVision) {
  const std::string five = "[\"-0.25\", \"0.12\", \"0.01\", \"0.001\", \"-0.0005\"]";
  const auto with_lens = [&](const std::string& type, const std::string& list) {
    return load_one("cameras.sfm",
                    text_with(text_with(meshroom, "\"brown\"", "\"" + type + "\""), five, list));
  };
  expect_lens(with_lens("radial3", "[\"-0.25\", \"0.12\", \"0.01\"]"), LensModel::BrownConrady,
              {-0.25, 0.12, 0, 0, 0.01});
  expect_lens(with_lens("radial1", "[\"-0.25\"]"), LensModel::BrownConrady, {-0.25});
  expect_lens(with_lens("pinhole", "\"\""), LensModel::BrownConrady, {});
  expect_lens(with_lens("fisheye4", "[\"0.1\", \"0.2\", \"0.3\", \"0.4\"]"), LensModel::Fisheye,
              {0.1, 0.2, 0.3, 0.4});
  expect_lens(with_lens("fisheye1", "[\"0.9\"]"), LensModel::FieldOfView, {0.9});
  expect_lens(with_lens("pinhole\", \"distortionType\": \"radialk1", "[\"-0.25\"]"),
              LensModel::BrownConrady, {-0.25});
}

TEST(CameraPrograms, ReadsEarlyVersionsOfAliceVisionInPx) {
  const Camera camera = load_one("cameras.sfm", R"({"version": ["1", "0", "0"], "intrinsics": [
    {"intrinsicId": "7", "width": "640", "height": "480", "type": "radial3",
     "pxInitialFocalLength": "710", "pxFocalLength": "700", "principalPoint": ["321", "238"],
     "distortionParams": ["-0.25", "0.12", "0.01"], "locked": "false"}]})");
  EXPECT_EQ(camera.fx, 700);
  EXPECT_EQ(camera.cx, 321);
  EXPECT_EQ(camera.cy, 238);
}

TEST(CameraPrograms, RefusesWhatItDoesNotKnowOfAliceVision) {
  expect_refused_text(
      "cameras.sfm", text_with(meshroom, "\"brown\"", "\"3deradial4\""),
      {"cameras.sfm", "intrinsics/77/type", "AliceVision", "3deradial4", "radial3"});
  expect_refused_text("cameras.sfm", text_with(meshroom, "\"brown\"", "\"radial3\""),
                      {"intrinsics/77/distortionParams", "5 coefficients", "3 of"});
  expect_refused_text("cameras.sfm", text_with(meshroom, "[\"0\", \"0\"]", "[\"3\", \"0\"]"),
                      {"undistortionOffset", "AliceVision"});
  expect_refused_text("cameras.sfm", text_with(meshroom, "\"version\"", "\"edition\""),
                      {"version"});
}

// --- Project Aria

std::string aria(const std::string& label, const std::string& center,
                 const std::string& model = "FisheyeRadTanThinPrism") {
  return R"({"CameraCalibrations": [{"Calibrated": true, "Label": ")" + label +
         R"(", "Projection": {"Description": "see FisheyeRadTanThinPrism.h", "Name": ")" + model +
         R"(", "Params": [600, )" + center +
         R"(, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12]}, "SerialNumber": "1",
    "T_Device_Camera": {"Translation": [0, 0, 0], "UnitQuaternion": [1, [0, 0, 0]]}}],
    "ImuCalibrations": [{"Label": "imu-left", "Accelerometer": {"Bias": {"Name": "Constant"}}}],
    "DeviceClassInfo": {"BuildVersion": "EVT2", "DeviceClass": "Aria"}})";
}

TEST(CameraPrograms, ReadsTheFactoryCalibrationOfAria) {
  const Camera slam = load_one("calib.json", aria("camera-slam-left", "321, 238"));
  EXPECT_EQ(slam.width, 640);
  EXPECT_EQ(slam.height, 480);
  EXPECT_EQ(slam.fx, 600);
  EXPECT_EQ(slam.fy, 600);
  EXPECT_EQ(slam.cx, 321);
  EXPECT_EQ(slam.cy, 238);
  expect_lens(slam, LensModel::Fisheye, {1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12});
}

TEST(CameraPrograms, ChoosesTheSizeOfAriasImages) {
  const std::vector<FileCamera> cameras =
      load_text("calib.json", aria("camera-rgb", "1450.5, 1440.5"));
  ASSERT_EQ(cameras.size(), 2u);
  const auto of_size = [&](int side) {
    return choose_camera(
        cameras, "camera-rgb", [&] { return SizePx(side, side); }, "calib.json");
  };
  EXPECT_EQ(of_size(2880).cx, 1450.5);
  EXPECT_EQ(of_size(1408).fx, 300);
  EXPECT_EQ(of_size(1408).cx, (1450.5 - 32 + 0.5) / 2 - 0.5);
  EXPECT_EQ(of_size(1408).cy, (1440.5 - 32 + 0.5) / 2 - 0.5);
  // A later device has another sensor.
  EXPECT_EQ(load_one("calib.json", aria("camera-rgb", "2010, 1510")).width, 0);
  expect_refused_text("calib.json", aria("camera-rgb", "1450, 1440", "Spherical"),
                      {"calib.json", "Spherical", "FISHEYE624"});
}

// --- DSO

TEST(CameraPrograms, ReadsDsoInPx) {
  const std::string size = "\n640 480\ncrop\n640 480\n", k = " 700 701 321 238 ";
  expect_pinhole(load_one("camera.txt", "Pinhole" + k + "0" + size));
  const std::string four = k + "-0.25 0.12 0.001 -0.0005" + size;
  for (const std::string& name : {"RadTan", ""}) {
    const Camera camera = load_one("camera.txt", name + four);
    expect_pinhole(camera);
    expect_lens(camera, LensModel::BrownConrady, {-0.25, 0.12, 0.001, -0.0005});
  }
  for (const std::string& name : {"EquiDistant", "KannalaBrandt"})
    expect_lens(load_one("camera.txt", name + four), LensModel::Fisheye,
                {-0.25, 0.12, 0.001, -0.0005});
  expect_lens(load_one("camera.txt", "FOV" + k + "0.9" + size), LensModel::FieldOfView, {0.9});
  expect_pinhole(load_one("camera.txt", "FOV" + k + "0" + size));
}

TEST(CameraPrograms, ReadsDsoInPartsOfTheSides) {
  const std::string k = "0.5 0.75 0.5 0.25 0.9\n1280 1024\n";
  for (const std::string& text :
       {"FOV " + k + "crop\n640 480\n", k + "0.4 0.53 0.5 0.5 0\n640 480\n", k + "full\n640 480"}) {
    const Camera camera = load_one("camera.txt", text);
    EXPECT_EQ(camera.width, 1280);
    EXPECT_EQ(camera.height, 1024);
    EXPECT_EQ(camera.fx, 640);
    EXPECT_EQ(camera.fy, 768);
    EXPECT_EQ(camera.cx, 639.5);
    EXPECT_EQ(camera.cy, 255.5);
    expect_lens(camera, LensModel::FieldOfView, {0.9});
  }
}

TEST(CameraPrograms, RefusesOtherFilesOfDso) {
  const std::string size = "\n640 480\ncrop\n640 480\n";
  expect_refused_text("camera.txt", "RadTan 700 701 321 238 -0.25" + size,
                      {"camera.txt", "RadTan", "5 numbers", "DSO", "8"});
  expect_refused_text("camera.txt", "Pinhole 700 701 321 238 0.9" + size, {"Pinhole", "0.9"});
  expect_refused_text("camera.txt", "Pinhole 700 701 0.5 238 0" + size, {"cx, cy", "both in px"});
}

// --- HALCON

std::string halcon(const std::string& lens) {
  return R"(# INTERNAL CAMERA PARAMETERS

ParGroup: Camera: Parameter;
  "Internal camera parameters";

Focus:foc:      0.007;
  DOUBLE:0.0:;
  "Focal length of the lens [meter]";

)" + lens +
         R"(Sx:sx:  1e-05;
  DOUBLE:0.0:;
  "Width of a cell on the sensor [meter]";

Sy:sy:  9.985734664764623e-06;
  DOUBLE:0.0:;
  "Height of a cell on the sensor [meter]";

Cx:cx:  321;
  DOUBLE::;
  "X-coordinate of the image center [pixel]";

Cy:cy:  238;
  DOUBLE::;
  "Y-coordinate of the image center [pixel]";

ImageWidth:imgw: 640;
  INT:1:32767;
  "Width of the images [pixel]";

ImageHeight:imgh: 480;
  INT:1:32767;
  "Height of the images [pixel]";
)";
}

const std::string kappa = R"(Kappa:kappa:    -2253.5;
  DOUBLE::;
  "Radial distortion coefficient [1/(meter*meter)]";

)";

TEST(CameraPrograms, ReadsHalconWithoutDistortion) {
  expect_pinhole(load_one("camera.cal", halcon(text_with(kappa, "-2253.5", "0.0"))));
  expect_pinhole(load_one("camera.dat", halcon("Poly1:poly1: 0;\n  DOUBLE::;\n\n")));
  const Camera camera =
      load_one("tuple.txt", "['area_scan_division', 0.007, 0, 1e-05, 1e-05, 321, 238, 640, 480]");
  EXPECT_NEAR(camera.fx, 700, 1e-9);
  EXPECT_EQ(camera.height, 480);
}

TEST(CameraPrograms, RefusesHalconsLenses) {
  expect_refused_text(
      "camera.cal", halcon(kappa),
      {"camera.cal: Kappa", "HALCON, division model (-2253.5)", "change_radial_distortion_image"});
  expect_refused_text("camera.dat", halcon("Poly4:poly4: 0.02;\n  DOUBLE::;\n\n"),
                      {"Poly4", "HALCON, polynomial model"});
  expect_refused_text("camera.dat", halcon("Tilt:tilt: 3;\n  DOUBLE::;\n\n"), {"HALCON", "Tilt"});
  expect_refused_text("camera.dat", text_with(halcon(""), "0.007", "0"), {"Focus", "telecentric"});
  expect_refused_text("camera.dat", text_with(halcon(""), "Camera:", "LinescanCamera:"),
                      {"HALCON", "line scan"});
  expect_refused_text("tuple.txt",
                      "['area_scan_division', 0.007, -2253.5, 1e-05, 1e-05, 321, 238, 640, 480]",
                      {"Kappa", "division model"});
  expect_refused_text("tuple.txt",
                      "['area_scan_telecentric_division', 0.1, 0, 1, 1, 2, 3, 640, 480]",
                      {"HALCON", "area_scan_telecentric_division"});
}

// --- not read

TEST(CameraPrograms, NamesProgramsThatAreNotRead) {
  expect_refused_text("metashape.xml",
                      "<?xml version=\"1.0\"?><calibration><projection>frame</projection>"
                      "<width>640</width><height>480</height><f>700</f><cx>1.5</cx><cy>1.5</cy>"
                      "<k1>-0.25</k1></calibration>",
                      {"metashape.xml", "Agisoft Metashape", "OpenCV"});
  expect_refused_text("bundle.out",
                      "# Bundle file v0.3\n1 0\n700 -0.25 0.12\n1 0 0\n0 1 0\n0 0 1\n"
                      "0 0 0\n",
                      {"Bundler"});
  expect_refused_text("calib_results.txt",
                      "#polynomial coefficients for the DIRECT mapping function (ocam_model.ss)\n\n"
                      "5 -700 0 0.001 0 0\n",
                      {"OCamCalib"});
}

}  // namespace
}  // namespace edgescout::test
