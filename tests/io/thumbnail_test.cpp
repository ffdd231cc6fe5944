// The thumbnail that a drawn PNG file carries.
#include "host/io/thumbnail.h"

#include <gtest/gtest.h>

#include <opencv2/imgcodecs.hpp>

#include "tests/io/temporary_folder.h"

namespace edgescout::test {
namespace {

RgbImage half_red(int width, int height) {
  RgbImage image{width, height, {}};
  for (int i = 0; i < width * height; ++i)
    for (const int value : {i % width < width / 2 ? 220 : 20, 20, 20})
      image.pixels.push_back(static_cast<std::uint8_t>(value));
  return image;
}

cv::Mat decoded(const std::string& bytes) {
  return cv::imdecode(
      cv::Mat(1, static_cast<int>(bytes.size()), CV_8U, const_cast<char*>(bytes.data())),
      cv::IMREAD_COLOR);
}

TEST(Thumbnail, IsASmallJpegInAWholePng) {
  const TemporaryFolder folder;
  const auto file = folder.path() / "a.png";
  const RgbImage image = half_red(640, 480);
  save_png_with_thumbnail(image, file);
  const std::string jpeg = thumbnail_in(file).value();
  EXPECT_TRUE(jpeg.starts_with("\xff\xd8"));
  EXPECT_NE(content_of(file).find(jpeg), std::string::npos) << "read, not made";
  const cv::Mat small = decoded(jpeg);
  ASSERT_EQ(small.size(), cv::Size(200, 150));
  EXPECT_NEAR(small.at<cv::Vec3b>(75, 50)[2], 220, 5) << "red is red";
  EXPECT_NEAR(small.at<cv::Vec3b>(75, 150)[2], 20, 5);

  const cv::Mat whole = cv::imread(file.string());
  ASSERT_EQ(whole.size(), cv::Size(640, 480));
  EXPECT_EQ(whole.at<cv::Vec3b>(10, 10), cv::Vec3b(20, 20, 220));
  EXPECT_EQ(load_image(file).width, 640) << "with its own check of chunks";
}

TEST(Thumbnail, FitsIntoASquareAndIsNotEnlarged) {
  const TemporaryFolder folder;
  const auto size_of = [&](int width, int height) {
    save_png_with_thumbnail(half_red(width, height), folder.path() / "a.png");
    return decoded(thumbnail_in(folder.path() / "a.png").value()).size();
  };
  EXPECT_EQ(size_of(480, 640), cv::Size(150, 200));
  EXPECT_EQ(size_of(160, 120), cv::Size(160, 120));
  EXPECT_EQ(size_of(4000, 16), cv::Size(200, 1));
}

TEST(Thumbnail, IsMadeOfPixelsWhereTheFileCarriesNone) {
  const TemporaryFolder folder;
  save_png(half_red(640, 480), folder.path() / "a.png");
  EXPECT_EQ(decoded(thumbnail_in(folder.path() / "a.png").value()).size(), cv::Size(200, 150));
}

TEST(Thumbnail, IsNothingWithoutAWholePng) {
  const TemporaryFolder folder;
  EXPECT_FALSE(thumbnail_in(folder.path() / "none.png"));
  EXPECT_FALSE(thumbnail_in(folder.path()));
  EXPECT_FALSE(thumbnail_in(folder.write("a.png", "")));
  EXPECT_FALSE(thumbnail_in(folder.write("b.png", "no image at all, but longer than a header is")));
  save_png_with_thumbnail(half_red(640, 480), folder.path() / "c.png");
  const std::string whole = content_of(folder.path() / "c.png");
  EXPECT_FALSE(thumbnail_in(folder.write("d.png", whole.substr(0, 200)))) << "cut in the thumbnail";
}

}  // namespace
}  // namespace edgescout::test
