// What a camera file says and is not understood, and encodings of text.
#include "tests/io/camera_sample.h"
#include "tests/io/expect_input_error.h"

namespace edgescout::test {
namespace {

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
