// What a camera file says and is not understood, and encodings of text.
#include "tests/io/camera_sample.h"
#include "tests/io/expect_input_error.h"

namespace edgescout::test {
namespace {

// Each was found by the fuzzer.
TEST(CameraFormats, RefusesNumbersThatNoFieldHolds) {
  expect_input_error(
      [] {
        load_one("camera.json", R"({"ImageSize": [480, 6.5e65], "RadialDistortion": [-0.25, 0.12],
            "FocalLength": [700, 701], "PrincipalPoint": [322, 239], "Skew": 0})");
      },
      {"camera.json", "ImageSize", "6.5e+65", "width and height"});
  expect_input_error(
      [] {
        load_one("camera.csv",
                 "%time,field.height,field.width,field.K,field.K1\n1,480,640,700,0\n");
      },
      {"camera.csv", "K", "a value alone"});
  expect_input_error(
      [] {
        load_one("ost.txt", "[image]\n\nname\n640\n\n[head]\n\n3\n\ncamera matrix\n700 0 321\n");
      },
      {"ost.txt", "name", "a value alone"});
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
  refused("roi: {x_offset: -10, y_offset: 0, width: 640, height: 480}\n",
          {"roi/x_offset", "-10", "at least 0"});
  refused("roi: {x_offset: 10, y_offset: 0}\n", {"roi", "offset without a size"});
  refused("camera_model: omni\nD: [0.1, 0, 0, 0]\n", {"camera_model", "omni", "kannala_brandt"});
  refused("binning: 2\n", {"binning"});
  refused("camera_model: ds\nxi: 0.5\n", {"camera_model", "ds"});
  refused("xi: 0.5\n", {"xi"});
  refused("k7: 0.5\n", {"k7"});
  refused("distortion_model: division\nD: [0.1]\n", {"distortion_model", "division"});
  refused("distortion_model: none\nD: [0.1, 0, 0, 0]\n", {"D", "distortion_model"});
  refused("fisheye: true\nD: [0.1, 0, 0, 0, 0.3]\n", {"D", "5 coefficients", "4"});
  refused("is_fisheye: true\n", {"coefficients of the model in is_fisheye"});
  refused("is_rectified: 1\nD: [0.1, 0, 0, 0]\n", {"D", "as is_rectified says"});
  refused("k1: 0.1\ndistortion: {k1: 0.2}\n", {"k1", "0.1", "0.2"});
  refused("D: [0.1, 0.2, 0.3]\n", {"D", "3 coefficients", "4, 5, 8, 12, 14"});
  refused("D: [0.1, 0.2, 0, 0]\nk1: 0.3\n", {"k1", "D"});
  refused("camera_matrix: [[650, 0, 321], [0, 701, 238], [0, 0, 1]]\n", {"fx", "650", "700"});
  refused("image_width: 800\n", {"image_width", "twice"});
  refused("width: 800\n", {"width", "800", "640"});
  refused("x0: 12\n", {"K", "cx 321", "cx 12"});
  for (const char* geometry : {"omega: 0.9\n",
                               "kappa: -1200\n",
                               "tilt: [0.1, 0.02]\n",
                               "decentering: [0.001, 0.002]\n",
                               "radial_params: [-0.25, 0.1]\n",
                               "poly: [-0.25, 0.1]\n",
                               "barrel: 0.1\n",
                               "b1: 0.5\n",
                               "shear: 2\n",
                               "s: 2\n",
                               "t1: 0.001\n",
                               "r1: -0.25\n",
                               "c2: 0.1\n",
                               "g1: 0.001\n",
                               "lut: [[0.1, 0.2], [0.3, 0.4]]\n",
                               "lens_lut: lens.bin\n",
                               "LookupTable: {x: [0, 1], y: [0, 1]}\n",
                               "map_x: [0.1, 1.1, 2.2]\n",
                               "xy_table: table.npy\n",
                               "kc1: -0.25\n",
                               "p: [0.001, -0.0005]\n",
                               "D_order: k1 k2 k3 p1 p2\n",
                               "param_names: [fx, fy, k1]\n",
                               "x1: 10\n",
                               "sensor_area: [10, 20, 300, 200]\n",
                               "D: [{name: k1, value: -0.25}]\n",
                               "d1: -0.25\n",
                               "aoi: {x: 10, width: 300}\n",
                               "window: [10, 20, 300, 200]\n",
                               "AreaOfInterest: [10, 20]\n",
                               "StartX: 10\n",
                               "left: 10\n",
                               "cx_offset: 3\n",
                               "decimation: 2\n",
                               "downscale: 2\n",
                               "zoom: 2\n",
                               "scale_factor: 0.5\n",
                               "bin_x: 2\n",
                               "ReverseX: true\n",
                               "flip: 1\n",
                               "mirrored: both\n",
                               "rotate: 90\n",
                               "image_rotation: 180\n",
                               "orientation: 6\n",
                               "padding: [8, 8]\n",
                               "telecentric: true\n",
                               "type: orthographic\n",
                               "cam_model: omni\n",
                               "kind: fisheye\n",
                               "inverse_distortion: [-0.25, 0.12, 0, 0]\n",
                               "distortion_inverse: {k1: -0.25}\n",
                               "undistortion: {k1: -0.25}\n",
                               "dc: [0.1, 0, 0, 0]\n",
                               "D_rect: [0.1, 0, 0, 0]\n",
                               "rad: [-0.25, 0.12]\n",
                               "mei_xi: 0.9\n",
                               "aberration: 0.1\n",
                               "bin: 2\n",
                               "resolution: [1280, 960]\n",
                               "ImageSize: [960, 1280]\n",
                               "img_size: 1280x960\n",
                               "shape: [960, 1280, 3]\n",
                               "D: '<sequence type: double, length: 5>'\n"}) {
    const std::string field = geometry;
    refused(field, {"camera.yaml", field.substr(0, field.find(':')).c_str(), "expected"});
  }
  refused("distortion: {a: -0.25, b: 0.12}\n", {"distortion/a"});
  refused("D: {0: -0.25, 1: 0.12}\n", {"D/0"});
  for (const char* harmless :
       {"square_size: 50\nboard_width: 9\nboard_height: 6\nflags: 2\nfix_aspect_ratio: 1\n",
        "per_view_reprojection_errors: [0.1, 0.2]\nfix_k3: 1\nzero_tangent_dist: 1\n",
        "camera_name: K1\nsensor: k1\ncomment: k1 only\nfix: [k1]\n",
        "camera_name: fisheye\nregion: EU\ndistro: humble\nwindow: calibration\n",
        "decimation: 1\n",
        "resolution: [640, 480]\n",
        "ImageSize: [480, 640]\n",
        "resolution: VGA\n",
        "size: [9, 6]\n",
        "shape: [480, 640, 3]\n",
        "resolution: 0.001\n",
        "bin: calibration.bin\n",
        "rad: 0.1\n",
        "aberration: 0\n",
        "zoom: 1\n",
        "flip: false\n",
        "rotate: 0\n",
        "orientation: 1\n",
        "rotation: [[1, 0, 0], [0, 1, 0], [0, 0, 1]]\n",
        "binning: 1x1\n",
        "lensPosition: 135\n",
        "depth_scale: 0.001\n",
        "scale: 0.33\n",
        "offset: [0.5, 0.5]\n",
        "t_00: 0.1\n",
        "aspect_ratio: 1.333\n",
        "polymorphic_id: 1\n",
        "color_lut: film.cube\nlut: ''\n",
        "distortion: {rms: 0.2, num_coeffs: 5, version: 2}\n",
        "r: [1, 0, 0, 0, 1, 0, 0, 0, 1]\nR1: [1, 0, 0, 0, 1, 0, 0, 0, 1]\n"})
    expect_pinhole(load_one("camera.yaml", head + harmless));
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
  refused("1 0 0 0\n0 1 0 0\n0 0 1 0\n0 0 0 1\n", {"K", "the identity", "calibrated"});
  refused("K: [700, 701, 321]\n", {"K", "3 numbers"});
  refused("fx: 700\nfy: 701\ncx: 321\n", {"cy", "nothing"});
  refused("f: 700\naspect: 1.1\ncx: 321\ncy: 238\n", {"aspect", "1.1", "both axes"});
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
