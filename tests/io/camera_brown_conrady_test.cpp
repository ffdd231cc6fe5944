// The same camera with radial and tangential distortion as many programs write it.
#include "tests/io/camera_sample.h"

namespace edgescout::test {
namespace {

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
    {"ROS 2, printed by Python", "info.txt",
     "sensor_msgs.msg.CameraInfo(header=std_msgs.msg.Header(stamp=builtin_interfaces.msg.Time(sec="
     "1, "
     "nanosec=2), frame_id='cam'), height=480, width=640, distortion_model='plumb_bob', "
     "d=array('d', "
     "[-0.25, 0.12, 0.001, -0.0005, 0.0]), k=array([700., 0., 321., 0., 701., 238., 0., 0., 1.], "
     "dtype=float64), r=[1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0], binning_x=0, binning_y=0, "
     "roi=sensor_msgs.msg.RegionOfInterest(x_offset=0, y_offset=0, height=0, width=0, "
     "do_rectify=False))\n"},
    {"ROS 2 echo --csv", "info.csv",
     "1,2,cam,480,640,plumb_bob,-0.25,0.12,0.001,-0.0005,0.0,700.0,0.0,321.0,0.0,701.0,238.0,0.0,0."
     "0,"
     "1.0,1.0,0.0,0.0,0.0,1.0,0.0,0.0,0.0,1.0,650.0,0.0,320.0,0.0,0.0,650.0,240.0,0.0,0.0,0.0,1.0,"
     "0.0,0,0,0,0,0,0,False\n"},
    {"ROS 2 echo behind lost messages", "echo.txt",
     "A message was lost!!!\n\ttotal count change:1\n\ttotal count: 1---\nheight: 480\nwidth: "
     "640\ndistortion_model: plumb_bob\nd: [-0.25, 0.12, 0.001, -0.0005]\nk: [700, 0, 321, 0, 701, "
     "238, 0, 0, 1]\n---\nA message was lost!!!\n\ttotal count change:1\n\ttotal count: 2---\n"},
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
    {"ROS, table of rostopic echo -p", "info.csv",
     "%time,field.header.seq,field.height,field.width,field.distortion_model,field.D0,field.D1,"
     "field.D2,field.D3,field.K0,field.K1,field.K2,field.K3,field.K4,field.K5,field.K6,field.K7,"
     "field.K8,field.binning_x\n"
     "1,1,480,640,plumb_bob,-0.25,0.12,0.001,-0.0005,700,0,321,0,701,238,0,0,1,0\n"
     "2,2,480,640,plumb_bob,-0.25,0.12,0.001,-0.0005,700,0,321,0,701,238,0,0,1,0\n"},
    {"ROS, section of the camera's name", "camera.ini",
     "# Camera intrinsics\n\n[image]\n\nwidth\n640\n\nheight\n480\n\n[head]\n\ncamera matrix\n"
     "700 0 321\n0 701 238\n0 0 1\n\ndistortion\n-0.25 0.12 0.001 -0.0005 0\n"},
    {"OpenCV stereo, one camera", "left.yml", R"(%YAML:1.0
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
size: [ 640, 480 ]
)"},
    {"Python, arrays of one array", "calib.json",
     R"({"DIM": [640, 480], "matrix": [[[700, 0, 321], [0, 701, 238], [0, 0, 1]]],
 "coefs": [[[-0.25], [0.12], [0.001], [-0.0005]]]})"},
    {"Python, printed dictionary", "calib.txt",
     "{'K': array([[700.,   0., 321.],\n       [  0., 701., 238.],\n       [  0.,   0.,   1.]]), "
     "'dist': array([[-0.25, 0.12, 0.001, -0.0005]]), 'image_size': (640, 480)}\n"},
    {"numpy, assigned", "calib.txt",
     "mtx = [[700.   0. 321.]\n [  0. 701. 238.]\n [  0.   0.   1.]]\n"
     "dist = [[-0.25 0.12 0.001 -0.0005]]\nimage_size = (640, 480)\n"},
    {"numpy, printed below names", "calib.txt",
     "Camera matrix :\n\n[[700.   0. 321.]\n [  0. 701. 238.]\n [  0.   0.   1.]]\ndist :\n\n"
     "[[-0.25 0.12 0.001 -0.0005]]\nimage size: 640 480\n"},
    {"names before numbers", "calib.txt",
     "fx 700\nfy 701\ncx 321\ncy 238\nd -0.25 0.12 0.001 -0.0005\nsize 640 480\n"},
    {"table with commas", "calib.csv",
     "fx,fy,cx,cy,k1,k2,p1,p2,width,height\n700,701,321,238,-0.25,0.12,0.001,-0.0005,640,480\n"},
    {"vikit, SVO", "camera.yaml",
     "cam_model: Pinhole\ncam_width: 640\ncam_height: 480\ncam_fx: 700\ncam_fy: 701\n"
     "cam_cx: 321\ncam_cy: 238\ncam_d0: -0.25\ncam_d1: 0.12\ncam_d2: 0.001\ncam_d3: -0.0005\n"},
    {"camodocal, all coefficients", "cam.yaml", R"(%YAML:1.0
---
model_type: PINHOLE_FULL
image_width: 640
image_height: 480
distortion_parameters: {k1: -0.25, k2: 0.12, k3: 0, k4: 0, k5: 0, k6: 0, p1: 0.001, p2: -0.0005}
projection_parameters: {fx: 700, fy: 701, cx: 321, cy: 238}
)"},
    {"Bouguet's toolbox", "Calib_Results.m", R"(% Intrinsic and Extrinsic Camera Parameters
%-- Focal length:
fc = [ 700.000000000000000 ; 701.000000000000000 ];
cc = [ 321 ; 238 ];
alpha_c = 0.000000000000000;
kc = [ -0.25 ; 0.12 ; 0.001 ; -0.0005 ; 0.000000000000000 ];
fc_error = [ 0.3 ; 0.3 ];
nx = 640;
ny = 480;
est_dist = [ 1 ; 1 ; 1 ; 1 ; 0 ];
)"},
    {"MATLAB, assigned", "camera.m",
     "cameraParams.FocalLength = [700 701];\ncameraParams.PrincipalPoint = [322 239];\n"
     "cameraParams.RadialDistortion = [-0.25 0.12];\n"
     "cameraParams.TangentialDistortion = [0.001 -0.0005];\n"
     "cameraParams.ImageSize = [480 640];\n"},
    {"MATLAB's names in another spelling", "camera.json",
     R"({"imageSize": [480, 640], "radialDistortion": [-0.25, 0.12],
 "tangentialDistortion": [0.001, -0.0005], "focalLength": [700, 701], "principalPoint": [321, 238]})"},
    {"TOML, lists over several lines", "camera.toml",
     "[camera]\nwidth = 640\nheight = 480\nmatrix = [\n  [700.0, 0.0, 321.0], # fx\n"
     "  [0.0, 701.0, 238.0],\n  [0.0, 0.0, 1.0],\n]\n"
     "distortions = [\n  -0.25, 0.12, 0.001, -0.0005\n]\n"},
    {"TOML, dotted sections", "camera.toml",
     "[camera.intrinsics]\nfx = 700\nfy = 701\ncx = 321\ncy = 238\n[camera.distortion]\n"
     "coeffs = [-0.25, 0.12, 0.001, -0.0005]\n[camera.image]\nwidth = 640\nheight = 480\n"},
    {"RealSense, printed by Python", "rs.txt",
     "[ 640x480  p[321 238]  f[700 701]  Brown Conrady [-0.25 0.12 0.001 -0.0005 0] ]\n"},
    {"RealSense, printed in one line", "rs.txt",
     "width: 640, height: 480, ppx: 321, ppy: 238, fx: 700, fy: 701, model: Brown Conrady, "
     "coeffs: [-0.25, 0.12, 0.001, -0.0005, 0]\n"},
    {"Luxonis", "oak.json", R"({"boardName": "X", "cameraData": [[2, {"cameraType": 0,
 "distortionCoeff": [-0.25, 0.12, 0.001, -0.0005, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0], "height": 480,
 "intrinsicMatrix": [[700, 0, 321], [0, 701, 238], [0, 0, 1]], "lensPosition": 135,
 "specHfovDeg": 71.8, "width": 640}]]})"},
    {"YAML that merges a map", "camera.yaml",
     "size: &size {width: 640, height: 480}\ncam0:\n  <<: *size\n"
     "  K: [700, 0, 321, 0, 701, 238, 0, 0, 1]\n  D: [-0.25, 0.12, 0.001, -0.0005]\n"},
    {"OKVIS", "okvis.yaml", R"(cameras:
  - {T_SC: [1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1], image_dimension: [640, 480],
     distortion_coefficients: [-0.25, 0.12, 0.001, -0.0005], distortion_type: radialtangential,
     focal_length: [700, 701], principal_point: [321, 238]}
camera_params: {camera_rate: 20, sigma_absolute_translation: 0.0}
)"},
    {"names with px", "intrinsics.csv",
     "sensor_name,fx_px,fy_px,cx_px,cy_px,k1,k2,p1,p2,height_px,width_px\n"
     "front,700,701,321,238,-0.25,0.12,0.001,-0.0005,480,640\n"},
    {"a name and a value in each line", "camera.csv",
     "fx,700\nfy,701\ncx,321\ncy,238\nk1,-0.25\nk2,0.12\np1,0.001\np2,-0.0005\nwidth,640\n"
     "height,480\n"},
    {"a table with semicolons and quotes", "camera.csv",
     "\"fx\";\"fy\";\"cx\";\"cy\";\"k1\";\"k2\";\"p1\";\"p2\";\"width\";\"height\"\n"
     "\"700\";701;321;238;-0.25;0.12;0.001;-0.0005;640;480\n"},
    {"objects of x and y", "camera.json",
     R"({"focal_length": {"x": 700, "y": 701}, "principal_point": {"x": 321, "y": 238},
 "distortion": {"radial": [-0.25, 0.12], "tangential": [0.001, -0.0005], "rms": 0.2}, "width": 640,
 "height": 480})"},
};

class BrownConradyFile : public testing::TestWithParam<CameraSample> {};

TEST_P(BrownConradyFile, GivesTheSameCamera) {
  const Camera camera = load_one(GetParam().file, GetParam().text);
  expect_pinhole(camera);
  EXPECT_EQ(camera.lens, LensModel::BrownConrady);
  EXPECT_EQ(camera.distortion, (LensCoefficients{-0.25, 0.12, 0.001, -0.0005}));
}

INSTANTIATE_TEST_SUITE_P(CameraFormats, BrownConradyFile, testing::ValuesIn(brown_samples));

}  // namespace
}  // namespace edgescout::test
