// Calibrations of further programs: read, or refused in a line that says what to do.
#include <array>

#include "tests/io/camera_sample.h"
#include "tests/io/expect_input_error.h"

namespace edgescout::test {
namespace {

const LensCoefficients bent{-0.25, 0.12, 0.001, -0.0005};

void expect_without_size(const Camera& camera) { expect_pinhole(camera, 0, 0); }

const std::string kalibr = R"(Calibration results 
====================
Camera-system parameters:
cam0 (/left/image_raw):
    type: <class 'aslam_cv.libaslam_cv_python.DistortedPinholeCameraGeometry'>
    distortion: [-0.25 0.12 0.001
 -0.0005] +- [0.00053 0.00082 0.00008 0.0001]
    projection: [700.0 701.0 321.0 238.0] +- [0.42 0.43 0.31 0.32]
    reprojection error: [-0.000001, 0.000001] +- [0.289474, 0.287853]

cam1 (/right/image_raw):
    type: <class 'aslam_cv.libaslam_cv_python.EquidistantPinholeRsCameraGeometry'>
    distortion: [-0.01 0.02 -0.03 0.01] +- [0.00053 0.00082 0.00008 0.0001]
    projection: [800.0 801.0 319.0 241.0] +- [0.42 0.43 0.31 0.32]

baseline T_1_0:
    q: [0.00102 0.00213 0.00033 0.99999] +- [0.0004 0.0005 0.0001]
    t: [-0.11 0.0004 -0.0008] +- [0.00004 0.00004 0.0001]

Target configuration
====================
  Type: aprilgrid
  Tags: 
    Rows: 6
)";

TEST(CameraKinds, ReadsKalibrsResultsForEyes) {
  const Camera first = load_one("results-cam.txt", kalibr, "cam0");
  expect_without_size(first);
  EXPECT_EQ(first.lens, LensModel::BrownConrady);
  EXPECT_EQ(first.distortion, bent);
  const Camera second = load_one("results-cam.txt", kalibr, "cam1");
  EXPECT_EQ(second.lens, LensModel::Fisheye);
  EXPECT_EQ(second.fx, 800);
  EXPECT_EQ(second.distortion[3], 0.01);
  std::string omni = kalibr;
  omni.replace(omni.find("DistortedPinhole"), 16, "DistortedOmni");
  expect_input_error([&] { load_one("results-cam.txt", omni, "cam0"); },
                     {"results-cam.txt", "cam0", "DistortedOmni", "equidistant"});
}

TEST(CameraKinds, ReadsKalibrsResultsOfCameraAndImu) {
  const std::string text = R"(Calibration results
===================
Normalized Residuals
----------------------------
Reprojection error (cam0):     mean 0.2, median 0.18, std: 0.13

Transformation (cam0):
-----------------------
T_ci:  (imu0 to cam0): 
[[1. 0. 0. 0.]
 [0. 1. 0. 0.]
 [0. 0. 1. 0.]
 [0. 0. 0. 1.]]
cam0 to imu0 time: [s] (t_imu = t_cam + shift)
0.001

cam0
-----
  Camera model: pinhole
  Focal length: [700.0, 701.0]
  Principal point: [321.0, 238.0]
  Distortion model: radtan
  Distortion coefficients: [-0.25, 0.12, 0.001, -0.0005]
  Type: aprilgrid
  Tags: 
    Rows: 6

IMU configuration
=================
IMU0:
  Model: calibrated
)";
  const Camera camera = load_one("results-imucam.txt", text);
  expect_without_size(camera);
  EXPECT_EQ(camera.distortion, bent);
}

TEST(CameraKinds, ReadsWhatTheSdkOfAzureKinectPrints) {
  const std::string text = R"(Found 1 connected devices:

===== Device 0: 000123456789 =====
resolution width: 640
resolution height: 480
principal point x: 321
principal point y: 238
focal length x: 700
focal length y: 701
radial distortion coefficients:
k1: 0.72
k2: -2.88
k3: 1.63
k4: 0.6
k5: -2.7
k6: 1.56
center of distortion in Z=1 plane, x: 0
center of distortion in Z=1 plane, y: 0
tangential distortion coefficient x: 0.00078
tangential distortion coefficient y: -0.00014
metric radius: 0
)";
  const Camera camera = load_one("k4a.txt", text);
  expect_pinhole(camera);
  EXPECT_EQ(camera.distortion,
            (LensCoefficients{0.72, -2.88, 0.00078, -0.00014, 1.63, 0.6, -2.7, 1.56}));
  std::string moved = text;
  moved.replace(moved.find("plane, x: 0"), 11, "plane, x: 0.1");
  expect_input_error([&] { load_one("k4a.txt", moved); }, {"k4a.txt", "center of distortion"});
}

TEST(CameraKinds, SaysWhatIsMissingBesideADistortion) {
  const std::string xml = R"(<?xml version="1.0"?>
<opencv_storage>
<Distortion type_id="opencv-matrix">
  <rows>4</rows> <cols>1</cols> <dt>f</dt>
  <data> -0.25 0.12 0.001 -0.0005 </data></Distortion>
</opencv_storage>
)";
  const std::string yaml =
      "%YAML:1.0\nDistortion: !!opencv-matrix\n   rows: 1\n   cols: 5\n   dt: d\n"
      "   data: [ -0.25, 0.12, 0.001, -0.0005, 0. ]\n";
  for (const auto& [file, text] :
       {std::pair{"Distortion.xml", xml}, std::pair{"Distortion.yml", yaml}})
    expect_input_error([&] { load_one(file, text); },
                       {file, "camera_matrix: found the distortion alone", "a 3x3 matrix",
                        "in one file with the distortion"});
}

TEST(CameraKinds, ReadsAssignmentsOfPython) {
  const Camera camera = load_one("calibration.py", R"(import numpy as np
camera_matrix = np.array([[700.0, 0.0, 321.0],  # px
                          [0.0, 701.0, 238.0],
                          [0.0, 0.0, 1.0]], dtype=np.float64)
dist_coeffs = np.array([-0.25, 0.12, 0.001, -0.0005, 0.0])
)");
  expect_without_size(camera);
  EXPECT_EQ(camera.distortion, bent);
  expect_pinhole(load_one("k.txt", "fx=700 fy=701, cx=321 cy=238 w=640 h=480\n"));
}

TEST(CameraKinds, ReadsWhatMatlabShows) {
  const Camera camera = load_one("intrinsics.txt", R"(intrinsics = 

  cameraIntrinsics with properties:

             FocalLength: [700 701]
          PrincipalPoint: [322 239]
               ImageSize: [480 640]
        RadialDistortion: [-0.2500 0.1200]
    TangentialDistortion: [1.0000e-03 -5.0000e-04]
                    Skew: 0
                       K: [3x3 double]
)");
  expect_pinhole(camera);
  EXPECT_EQ(camera.distortion, bent);
  expect_input_error(
      [] {
        load_one("parameters.txt",
                 "  cameraParameters with properties:\n\n   Camera Intrinsics\n"
                 "          Intrinsics: [1x1 cameraIntrinsics]\n   Lens Distortion\n"
                 "    RadialDistortion: [-0.2500 0.1200]\n");
      },
      {"found the distortion alone"});
}

TEST(CameraKinds, ReadsStereoCalibrationsOfDatasets) {
  const std::string kitti =
      "P0: 7e+02 0 3.21e+02 0 0 7.01e+02 2.38e+02 0 0 0 1 0\n"
      "P1: 7e+02 0 3.21e+02 -386 0 7.01e+02 2.38e+02 0 0 0 1 0\n"
      "R0_rect: 1 0 0 0 1 0 0 0 1\nTr_velo_to_cam: 0 -1 0 0 0 0 -1 0 1 0 0 0\n";
  const std::vector<FileCamera> cameras = load_text("000000.txt", kitti);
  ASSERT_EQ(cameras.size(), 2u);
  for (const FileCamera& camera : cameras) expect_without_size(camera.camera);
  const std::string middlebury =
      "cam0=[700 0 321; 0 701 238; 0 0 1]\ncam1=[700 0 331; 0 701 238; 0 0 1]\ndoffs=10\n"
      "baseline=193.001\nwidth=640\nheight=480\nndisp=290\n";
  expect_pinhole(load_one("calib.txt", middlebury, "cam0"));
  EXPECT_EQ(load_one("calib.txt", middlebury, "cam1").cx, 331);
  expect_input_error([&] { load_one("calib.txt", middlebury); }, {"cam0", "camera_name"});
}

TEST(CameraKinds, ReadsOpenMvgsLenses) {
  const auto text = [](const std::string& lens) {
    return R"({"intrinsics": [{"key": 0, "value": {"ptr_wrapper": {"data": {"width": 640,
      "height": 480, "focal_length": 700.0, "principal_point": [321.0, 238.0], )" +
           lens + "}}}}]}";
  };
  EXPECT_EQ(load_one("sfm_data.json", text(R"("disto_k3": [-0.25, 0.12, 0.01])")).distortion,
            (LensCoefficients{-0.25, 0.12, 0, 0, 0.01}));
  EXPECT_EQ(load_one("sfm_data.json", text(R"("disto_k1": [-0.25])")).distortion,
            (LensCoefficients{-0.25}));
  expect_input_error([&] { load_one("sfm_data.json", text(R"("disto_k3": [-0.25])")); },
                     {"disto_k3", "1 coefficients", "3"});
}

TEST(CameraKinds, ReadsAPrintOfRealSenseBehindItsTitle) {
  expect_pinhole(
      load_one("rs.txt",
               "Color intrinsics: [ 640x480  p[321 238]  f[700 701]  Brown Conrady [0 0 0 0 0] ]"));
}

TEST(CameraKinds, RefusesFocalLengthsInAnotherUnit) {
  const std::string normalised =
      "width: 640\nheight: 480\nfx: 1.09375\nfy: 1.46\ncx: 0.5016\ncy: 0.4958\n";
  expect_input_error(
      [&] { load_one("c.yaml", normalised); },
      {"c.yaml", "fx, fy: found 1.09", "640x480", "in mm, or in parts of the width"});
  expect_input_error(
      [] {
        load_one("pix4d.cam",
                 "fileVersion 6\nimageWidth 640\nimageHeight 480\npixelSize 0.0024\n"
                 "focalLength 1.68\nprincipalPoint 0.77 0.57\n"
                 "radialDistortion -0.25 0.12 0\ntangentialDistortion 0.001 -0.0005\n");
      },
      {"pix4d.cam", "fx, fy", "in mm"});
  const Camera sizeless = load_one("k.txt", "1.09 0 0.5 0 1.46 0.49 0 0 1\n");
  expect_input_error([&] { camera_for_image(sizeless, 640, 480, false, "k.txt"); },
                     {"k.txt", "fx, fy", "640x480"});
}

TEST(CameraKinds, NamesAPointerOfGitLfs) {
  expect_input_error(
      [] {
        load_one("camera.yaml",
                 "version https://git-lfs.github.com/spec/v1\noid sha256:ab\nsize 12345\n");
      },
      {"camera.yaml", "a pointer of Git LFS", "git lfs pull"});
}

}  // namespace
}  // namespace edgescout::test
