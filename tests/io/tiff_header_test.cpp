#include "host/io/tiff_header.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "host/io/image.h"
#include "tests/io/expect_input_error.h"
#include "tests/io/gradient_image.h"

namespace edgescout::test {
namespace {

// A TIFF file of one grey strip. Each tag is a number of two bytes.
std::string tiff_of(const std::string& pixels, std::vector<std::pair<int, int>> tags) {
  const auto number = [](int value, int bytes) {
    std::string text;
    for (int i = 0; i < bytes; ++i) text += static_cast<char>(value >> 8 * i);
    return text;
  };
  constexpr int strip_at = 273, strip_bytes = 279, of_two_bytes = 3, of_four_bytes = 4;
  tags.insert(tags.end(), {{strip_at, 8}, {strip_bytes, int(pixels.size())}});
  std::sort(tags.begin(), tags.end());
  std::string file = "II*" + std::string(1, '\0') + number(8 + int(pixels.size()), 4) + pixels +
                     number(int(tags.size()), 2);
  for (const auto& [tag, value] : tags)
    file += number(tag, 2) + number(value < 65536 ? of_two_bytes : of_four_bytes, 2) +
            number(1, 4) + number(value, 4);
  return file + number(0, 4);
}

std::vector<std::pair<int, int>> grey_tags(int width, int height, int bits) {
  return {{256, width}, {257, height}, {258, bits}, {259, 1}, {262, 1}, {277, 1}, {278, height}};
}

TEST(TiffHeader, KeepsThePixelsOfATurnedTiffAsTheyAreStored) {
  const Image grey = gradient_image(24, 16);
  const std::string pixels(grey.pixels.begin(), grey.pixels.end());
  for (int orientation = 1; orientation <= 8; ++orientation) {
    auto tags = grey_tags(24, 16, 8);
    tags.emplace_back(274, orientation);
    const Image image = decode_image(tiff_of(pixels, tags), "x.tiff");
    EXPECT_EQ(image.width, 24) << orientation;
    EXPECT_EQ(image.pixels, grey.pixels) << orientation;
  }
}

TEST(TiffHeader, TakesZeroForWhiteWhereATiffSaysSo) {
  const Image grey = gradient_image(24, 16);
  for (const int bits : {8, 16}) {
    std::string inverted;
    for (const std::uint8_t pixel : grey.pixels)
      inverted.append(bits / 8, static_cast<char>(255 - pixel));  // 257 * (255 - pixel)
    auto tags = grey_tags(24, 16, bits);
    tags[4].second = 0;  // the photometric interpretation
    const Image image = decode_image(tiff_of(inverted, tags), "x.tiff");
    EXPECT_EQ(image.pixels, grey.pixels) << bits;
  }
}

TEST(TiffHeader, RefusesTiffPixelsItDoesNotRead) {
  const std::string pixels(4 * 24 * 16, 'x');
  const auto refused = [&](int bits, std::pair<int, int> tag, std::string_view word) {
    auto tags = grey_tags(24, 16, bits);
    std::erase_if(tags, [&](const auto& other) { return other.first == tag.first; });
    tags.push_back(tag);
    const std::string file = tiff_of(pixels, tags);
    expect_input_error([&] { decode_image(file, "x.tiff"); }, {"x.tiff", std::string(word)});
  };
  refused(16, {339, 3}, "real numbers of 16 bit");
  refused(32, {339, 1}, "whole numbers of 32 bit");
  refused(8, {262, 32803}, "raw values of a sensor");
}

}  // namespace
}  // namespace edgescout::test
