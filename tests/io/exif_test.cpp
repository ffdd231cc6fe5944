#include "host/io/exif.h"

#include <gtest/gtest.h>

namespace edgescout::test {
namespace {

// A segment with the tag, in both orders of bytes.
TEST(ExifOrientation, IsReadFromJpegFiles) {
  const std::string big(
      "\xff\xd8\xff\xe1\0\x22"
      "Exif\0\0MM\0*\0\0\0\x08\0\x01\x01\x12\0\x03\0\0\0\x01\0\x06\0\0"
      "\0\0\0\0\xff\xd9",
      40);
  EXPECT_EQ(exif_orientation(big), 6);
  const std::string little(
      "\xff\xd8\xff\xe1\0\x22"
      "Exif\0\0II*\0\x08\0\0\0\x01\0\x12\x01\x03\0\x01\0\0\0\x03\0\0\0"
      "\0\0\0\0\xff\xd9",
      40);
  EXPECT_EQ(exif_orientation(little), 3);
  for (std::size_t i = 0; i < big.size(); ++i) EXPECT_GE(exif_orientation(big.substr(0, i)), 1);
  EXPECT_EQ(exif_orientation("\x89PNG"), 1);
}

TEST(ExifOrientation, IsReadFromOtherFiles) {
  const std::string tag("II*\0\x08\0\0\0\x01\0\x12\x01\x03\0\x01\0\0\0\x03\0\0\0\0\0\0\0", 26);
  const std::string png = std::string("\x89PNG\r\n\x1a\n\0\0\0\x01zzzz.CRC.", 21) +
                          std::string(
                              "\0\0\0\x1a"
                              "eXIf",
                              8) +
                          tag;
  const std::string webp =
      std::string("RIFF\0\0\0\0WEBPVP8X\x03\0\0\0abc.EXIF\x1a\0\0\0", 32) + tag;
  for (const std::string& bytes : {tag, png, webp}) {
    EXPECT_EQ(exif_orientation(bytes), 3);
    for (std::size_t i = 0; i < bytes.size(); ++i)
      EXPECT_GE(exif_orientation(bytes.substr(0, i)), 1);
  }
}

}  // namespace
}  // namespace edgescout::test
