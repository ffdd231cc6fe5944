#include "host/io/png_chunks.h"

#include <gtest/gtest.h>

#include <opencv2/core.hpp>
#include <opencv2/imgcodecs.hpp>

#include "host/io/image.h"
#include "tests/io/expect_input_error.h"

namespace edgescout::test {
namespace {

// The decoder would write a line of its own to standard error.
TEST(PngChunks, SaysInOneLineThatAPngIsDamaged) {
  cv::Mat noise(20, 20, CV_8U);
  cv::randu(noise, 0, 255);
  std::vector<unsigned char> encoded;
  cv::imencode(".png", noise, encoded);
  const std::string whole(encoded.begin(), encoded.end());
  testing::internal::CaptureStderr();
  for (std::size_t i = 4; i < whole.size(); ++i)
    for (const char changed : {char(whole[i] ^ 0x20), char(whole[i] ^ 1), '\xff'}) {
      std::string damaged = whole;
      damaged[i] = changed;
      if (changed != whole[i])
        expect_input_error([&] { decode_image(damaged, "x.png"); }, {"x.png", "found", "expected"});
    }
  EXPECT_EQ(testing::internal::GetCapturedStderr(), "");
}

TEST(PngChunks, ReadsPngWithUnknownNotesAndNoOtherUnknownChunk) {
  cv::Mat grey(20, 20, CV_8U, cv::Scalar(77));
  std::vector<unsigned char> encoded;
  cv::imencode(".png", grey, encoded);
  constexpr std::size_t header_end = 33;
  const auto with_chunk = [&](const std::string& chunk) {
    std::string png(encoded.begin(), encoded.end());
    return png.insert(header_end, chunk);
  };
  const std::string note(
      "\0\0\0\0anNo"
      "\x53\x60\xb7\x12",
      12),
      needed(
          "\0\0\0\0CgBI"
          "\x28\x32\x21\xd9",
          12);
  EXPECT_EQ(decode_image(with_chunk(note), "x.png").pixels[0], 77);
  expect_input_error([&] { decode_image(with_chunk(needed), "x.png"); }, {"x.png", "CgBI"});
}

}  // namespace
}  // namespace edgescout::test
