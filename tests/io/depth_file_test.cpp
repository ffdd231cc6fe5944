#include "host/io/depth_file.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <opencv2/imgcodecs.hpp>

#include "tests/io/expect_input_error.h"

namespace edgescout::test {
namespace {

std::string file_of(const cv::Mat& values, const std::string& ending) {
  std::vector<std::uint8_t> bytes;
  cv::imencode(ending, values, bytes);
  return {bytes.begin(), bytes.end()};
}

// 20 x 16, of one value but for the first row's beginning.
cv::Mat depth_of(double value, std::vector<double> first, int type) {
  cv::Mat values(16, 20, type, cv::Scalar::all(value));
  for (std::size_t i = 0; i < first.size(); ++i)
    if (type == CV_16U)
      values.at<std::uint16_t>(0, int(i)) = std::uint16_t(first[i]);
    else
      values.at<float>(0, int(i)) = float(first[i]);
  return values;
}

TEST(DepthFile, WholeNumbersAreMillimetres) {
  const DepthImage depth = decode_depth(file_of(depth_of(650, {0, 1200}, CV_16U), ".png"), "a.png");
  EXPECT_EQ(depth.width, 20);
  EXPECT_EQ(depth.height, 16);
  EXPECT_EQ(depth.at(0, 0), DEPTH_MISSING);
  EXPECT_FLOAT_EQ(depth.at(1, 0), 1.2f);
  EXPECT_FLOAT_EQ(depth.at(19, 15), 0.65f);
}

TEST(DepthFile, RealNumbersAreMetres) {
  const double nan = std::numeric_limits<double>::quiet_NaN(),
               infinite = std::numeric_limits<double>::infinity();
  const DepthImage depth = decode_depth(
      file_of(depth_of(0.65, {nan, infinite, -infinite, -1, 0, 25, 0.01}, CV_32F), ".tiff"), "a");
  for (int i = 0; i < 7; ++i) EXPECT_EQ(depth.at(i, 0), DEPTH_MISSING) << i;
  EXPECT_FLOAT_EQ(depth.at(7, 0), 0.65f);
}

TEST(DepthFile, TheDatasetsUnitHoldsUnlessOneIsGiven) {
  const std::string file = file_of(depth_of(6500, {}, CV_16U), ".png");
  EXPECT_FLOAT_EQ(decode_depth(file, "a", {}, 1e-4).at(3, 3), 0.65f);
  DepthOptions options;
  options.unit_m = 2e-4;
  EXPECT_FLOAT_EQ(decode_depth(file, "a", options, 1e-4).at(3, 3), 1.3f);
}

TEST(DepthFile, RefusesPicturesOfDepth) {
  expect_input_error(
      [] { decode_depth(file_of(cv::Mat(16, 20, CV_8U, cv::Scalar(90)), ".png"), "grey.png"); },
      {"grey.png", "8 bit", "16 bit"});
  expect_input_error(
      [] {
        decode_depth(file_of(cv::Mat(16, 20, CV_16UC3, cv::Scalar(9, 9, 9)), ".png"), "jet.png");
      },
      {"jet.png", "3 channels", "one"});
}

// Metres taken for millimetres, and the other way round.
TEST(DepthFile, NamesTheMedianWhereTheUnitIsWrong) {
  expect_input_error([] { decode_depth(file_of(depth_of(3, {0}, CV_16U), ".png"), "m.png"); },
                     {"m.png", "values: found around 3", "0.003 m", "depth_unit"});
  expect_input_error([] { decode_depth(file_of(depth_of(650, {}, CV_32F), ".tiff"), "mm.tiff"); },
                     {"mm.tiff", "values: found around 650", "650 m", "depth_unit"});
}

TEST(DepthFile, AnImageWithoutAnyValueIsNoError) {
  const DepthImage depth = decode_depth(file_of(depth_of(0, {}, CV_16U), ".png"), "a");
  for (const float z_m : depth.z_m) EXPECT_EQ(z_m, DEPTH_MISSING);
}

TEST(DepthFile, ValuesInMemoryAreReadAlike) {
  std::vector<std::uint16_t> whole(320, 650);
  std::vector<float> real(320, 0.65f);
  EXPECT_EQ(depth_image(whole, 20, 16).z_m, depth_image(real, 20, 16).z_m);
  whole.pop_back();
  expect_input_error([&] { depth_image(whole, 20, 16); }, {"319", "20x16"});
}

// Padded rows, whole numbers of 32 bit, and the bytes of another machine.
TEST(DepthFile, PixelsInMemoryAreReadAlike) {
  std::vector<std::uint32_t> whole(16 * 23, 0xffffffff);
  for (int y = 0; y < 16; ++y)
    for (int x = 0; x < 20; ++x)
      whole[std::size_t(y) * 23 + std::size_t(x)] = std::uint32_t(650 + x);
  Pixels pixels{whole.data(), 20, 16, 23 * sizeof whole[0], PixelFormat::MonoUint32};
  const DepthImage depth = depth_image(pixels);
  EXPECT_FLOAT_EQ(depth.at(19, 15), 0.669f);
  for (std::uint32_t& value : whole) value = __builtin_bswap32(value);
  pixels.has_swapped_bytes = true;
  EXPECT_EQ(depth_image(pixels).z_m, depth.z_m);
  pixels.format = PixelFormat::Mono8;
  expect_input_error([&] { depth_image(pixels, {}, "depth topic"); }, {"depth topic", "a picture"});
}

}  // namespace
}  // namespace edgescout::test
