#include "host/bridge/ros2/image_message.h"

#include <gtest/gtest.h>

#include "tests/io/expect_input_error.h"
#include "tests/test_random.h"

namespace edgescout::ros2::test {

namespace {

using edgescout::test::expect_input_error;

constexpr int width = 20, height = 17;

std::uint8_t value_at(int x, int y, int channel) {
  return std::uint8_t(7 * x + 11 * y + 60 * channel + x * y % 13);
}

// Pixels of so many channels, each row followed by `padding` bytes.
msg::Image message(const std::string& encoding, int channels, int padding = 0) {
  msg::Image image{{}, height, width, encoding, 0, std::uint32_t(channels * width + padding), {}};
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x)
      for (int c = 0; c < channels; ++c) image.data.push_back(value_at(x, y, c));
    image.data.insert(image.data.end(), std::size_t(padding), 255);
  }
  return image;
}

// The same picture with its first three channels in the opposite order.
msg::Image reversed(msg::Image image, const std::string& encoding, int channels) {
  image.encoding = encoding;
  for (std::size_t i = 0; i + 2 < image.data.size(); i += std::size_t(channels))
    std::swap(image.data[i], image.data[i + 2]);
  return image;
}

Image grey(const msg::Image& image, const ImageOptions& options = {}) {
  return image_of(ImageMessage(image), "image", options);
}

// RGB for save_png.
RgbImage rgb(const msg::Image& bgr) { return {width, height, reversed(bgr, "rgb8", 3).data}; }

TEST(ImageMessage, GreyIsTakenAsItIs) {
  const Image image = grey(message("mono8", 1, 5));
  ASSERT_EQ(image.width, width);
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) EXPECT_EQ(image.at(x, y), value_at(x, y, 0));
}

TEST(ImageMessage, ColourIsThatOfAFile) {
  const msg::Image bgr = message("bgr8", 3);
  const Image of_file = decode_image(encode_png(rgb(bgr)), "file");
  EXPECT_EQ(grey(bgr).pixels, of_file.pixels);
  EXPECT_EQ(grey(reversed(bgr, "rgb8", 3)).pixels, of_file.pixels);
  EXPECT_EQ(grey(message("bgr8", 3, 6)).pixels, of_file.pixels);
  const Image with_alpha = grey(message("bgra8", 4));
  EXPECT_EQ(grey(reversed(message("bgra8", 4), "rgba8", 4)).pixels, with_alpha.pixels);
  EXPECT_EQ(with_alpha.pixels, of_file.pixels);  // the first three channels are the same
}

TEST(ImageMessage, DeepImagesFollowTheOptions) {
  msg::Image deep{{}, height, width, "mono16", 0, 2 * width, {}};
  std::vector<std::uint16_t> values;
  for (int i = 0; i < width * height; ++i) values.push_back(std::uint16_t(12 * i));
  for (const std::uint16_t value : values) {
    deep.data.push_back(std::uint8_t(value & 255));
    deep.data.push_back(std::uint8_t(value >> 8));
  }
  EXPECT_EQ(grey(deep).pixels, grey_image(values, width, height).pixels);
  ImageOptions full;
  full.scaling = GreyScaling::Full;
  EXPECT_EQ(grey(deep, full).pixels, grey_image(values, width, height, full).pixels);
  msg::Image big = deep;
  big.is_bigendian = 1;
  for (std::size_t i = 0; i < big.data.size(); i += 2) std::swap(big.data[i], big.data[i + 1]);
  EXPECT_EQ(grey(big).pixels, grey(deep).pixels);
}

TEST(ImageMessage, RealNumbersAreThoseOfAnArray) {
  std::vector<float> values;
  for (int i = 0; i < width * height; ++i) values.push_back(float(i) / float(width * height));
  msg::Image real{{}, height, width, "32FC1", 0, 4 * width, {}};
  const auto* bytes = reinterpret_cast<const std::uint8_t*>(values.data());
  real.data.assign(bytes, bytes + 4 * values.size());
  EXPECT_EQ(grey(real).pixels, grey_image(values, width, height).pixels);
}

TEST(ImageMessage, MosaicsAreThoseOfTheEncoding) {
  const msg::Image plain = message("mono8", 1);
  const std::pair<const char*, BayerPattern> kinds[] = {{"bayer_rggb8", BayerPattern::RGGB},
                                                        {"bayer_bggr8", BayerPattern::BGGR},
                                                        {"bayer_gbrg8", BayerPattern::GBRG},
                                                        {"bayer_grbg8", BayerPattern::GRBG}};
  for (const auto& [encoding, pattern] : kinds) {
    msg::Image mosaic = plain;
    mosaic.encoding = encoding;
    ImageOptions options;
    options.bayer = pattern;
    EXPECT_EQ(grey(mosaic).pixels, grey(plain, options).pixels) << encoding;
    EXPECT_NE(grey(mosaic).pixels, grey(plain).pixels) << encoding;
    // The pixels with their pattern in a file of image_transport's.
    const msg::CompressedImage png{{}, std::string(encoding) + "; png compressed ", [&] {
                                     const std::string bytes = encode_png(grey(plain));
                                     return std::vector<std::uint8_t>(bytes.begin(), bytes.end());
                                   }()};
    EXPECT_EQ(image_of(ImageMessage(png), "image").pixels, grey(mosaic).pixels) << encoding;
  }
}

TEST(ImageMessage, LumaOfVideoFormats) {
  const msg::Image yuyv = message("yuv422_yuy2", 2);
  msg::Image uyvy = message("yuv422", 2);
  EXPECT_EQ(grey(yuyv).at(3, 4), value_at(3, 4, 0));
  EXPECT_EQ(grey(uyvy).at(3, 4), value_at(3, 4, 1));
}

TEST(ImageMessage, CompressedIsThatOfAFile) {
  const std::string png = encode_png(rgb(message("bgr8", 3)));
  const msg::CompressedImage compressed{{}, "rgb8; png compressed bgr8", {png.begin(), png.end()}};
  EXPECT_EQ(image_of(ImageMessage(compressed), "image").pixels, decode_image(png, "file").pixels);
}

TEST(ImageMessage, RefusesWhatIsNoPicture) {
  expect_input_error([] { grey(message("64FC1", 8)); }, {"image: encoding: found 64FC1", "mono8"});
  expect_input_error([] { grey(message("", 1)); }, {"encoding"});
  expect_input_error([] { grey(message("a\nb\x7f", 1)); }, {"a?b?"});
  msg::Image image = message("mono8", 1);
  image.step = width - 1;
  expect_input_error([&] { grey(image); }, {"image: step: found 19 bytes"});
  image = message("mono8", 1);
  image.data.pop_back();
  expect_input_error([&] { grey(image); }, {"image: data: found 339 bytes", "340", "20x17"});
  image.data.resize(1000);
  expect_input_error([&] { grey(image); }, {"image: data: found 1000 bytes"});
  image = message("mono8", 1);
  image.width = image.height = image.step = 0xffffffff;
  expect_input_error([&] { grey(image); }, {"image: data"});
  image = message("mono8", 1);
  image.width = image.height = image.step = 0;
  image.data.clear();
  expect_input_error([&] { grey(image); }, {"image: pixels: found none"});
  image = message("mono8", 1);
  image.height = 0;
  expect_input_error([&] { grey(image); }, {"image: data: found 340 bytes"});
  image = {{}, 1, 20, "mono8", 0, 20, std::vector<std::uint8_t>(20)};
  expect_input_error([&] { grey(image); }, {"image size: found 20x1", "16x16"});
  const auto compressed = [](const std::string& format, std::vector<std::uint8_t> data) {
    image_of(ImageMessage(msg::CompressedImage{{}, format, std::move(data)}), "image");
  };
  expect_input_error([&] { compressed("jpeg", {}); }, {"image: image: found an empty file"});
  expect_input_error([&] { compressed("jpeg", {1, 2, 3}); }, {"image", "no image decoder"});
  expect_input_error([&] { compressed("16UC1; compressedDepth png", {1}); },
                     {"format", "distances"});
}

}  // namespace

}  // namespace edgescout::ros2::test
