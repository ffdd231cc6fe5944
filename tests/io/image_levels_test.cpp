// Which grey levels the values of a file become.
#include <gtest/gtest.h>

#include <cmath>
#include <opencv2/imgcodecs.hpp>

#include "host/io/image.h"
#include "tests/io/collected_log.h"
#include "tests/io/expect_input_error.h"
#include "tests/io/grey_ramp.h"
#include "tests/io/temporary_folder.h"

namespace edgescout::test {
namespace {

// The thresholds of edges are grey levels, so the levels must be those of the 8-bit image.
TEST(LoadImage, GivesDeepImagesTheLevelsOfTheirEightBitVersions) {
  const TemporaryFolder folder;
  for (const int white : {255, 1023, 4095, 16383, 65535, 4095 * 16})
    for (const char* name : {"deep.png", "deep.tif", "deep.pgm"}) {
      cv::Mat deep = ramp(CV_16U, white / 255.0);
      deep.at<std::uint16_t>(3, 3) = 0;
      deep.at<std::uint16_t>(4, 4) = 65535;  // a hot pixel
      cv::imwrite((folder.path() / name).string(), deep);
      expect_ramp(load_image(folder.path() / name), 0, name + std::to_string(white));
    }
  for (const double white : {1.0, 255.0, 65535.0}) {
    cv::imwrite((folder.path() / "real.tif").string(), ramp(CV_32F, white / 255));
    expect_ramp(load_image(folder.path() / "real.tif"), 0, "real " + std::to_string(white));
  }
}

TEST(LoadImage, LeavesHotPixelsOut) {
  const TemporaryFolder folder;
  const auto file = folder.path() / "hot.png";
  const auto with_hot_pixels = [&](int count) {
    cv::Mat deep = ramp(CV_16U, 4095 / 255.0);
    for (int i = 0; i < count; ++i) deep.at<std::uint16_t>(20 + i / 200, i % 200) = 65535;
    cv::imwrite(file.string(), deep);
    return load_image(file);
  };
  expect_ramp(with_hot_pixels(40), 0, "0.3 %");
  expect_ramp(with_hot_pixels(120), 0, "0.9 %");
  EXPECT_EQ(with_hot_pixels(1000).at(255, 10), 16);  // 8 %: a bright surface
}

TEST(LoadImage, KnowsWhereASignedTypeEnds) {
  const TemporaryFolder folder;
  const auto file = folder.path() / "signed.tif";
  cv::imwrite(file.string(), ramp(CV_16S, 100));
  if (cv::imread(file.string(), cv::IMREAD_UNCHANGED).depth() != CV_16S)
    GTEST_SKIP() << "this OpenCV writes no signed TIFF";
  EXPECT_NEAR(load_image(file).at(255, 10), 255 * 25500.0 / 32767, 1);
}

TEST(LoadImage, SpreadsTheValuesOfAnImageWithLittleContrast) {
  const TemporaryFolder folder;
  for (const auto& [scale, offset] : {std::pair{20.0, 30000.0}, {2.0, 1000.0}, {0.05, -6.0}}) {
    const bool real = offset < 0;
    const auto file = folder.path() / (real ? "low.tif" : "low.png");
    cv::imwrite(file.string(), ramp(real ? CV_32F : CV_16U, scale, offset));
    const Image image = load_image(file);
    EXPECT_NEAR(image.at(0, 10), 10, 1) << scale;
    EXPECT_NEAR(image.at(127, 10), 10 + 235 * 127 / 255.0, 1) << scale;
    EXPECT_NEAR(image.at(255, 10), 245, 1) << scale;
  }
  cv::Mat flat(20, 20, CV_16U, cv::Scalar(1000));  // noise is not enlarged
  flat.at<std::uint16_t>(5, 5) = 1010;
  cv::imwrite((folder.path() / "flat.png").string(), flat);
  const Image image = load_image(folder.path() / "flat.png");
  EXPECT_EQ(image.at(5, 5) - image.at(6, 6), 10);
}

TEST(LoadImage, TakesAStatedRange) {
  const TemporaryFolder folder;
  cv::imwrite((folder.path() / "deep.png").string(), ramp(CV_16U, 10, 2000));
  cv::imwrite((folder.path() / "grey.png").string(), ramp(CV_8U, 1));
  ImageOptions options;
  options.scaling = GreyScaling::Quantiles;
  expect_ramp(load_image(folder.path() / "deep.png", options), 1, "quantiles");
  options.scaling = GreyScaling::Full;
  EXPECT_EQ(load_image(folder.path() / "deep.png", options).at(255, 10),
            std::lround(4550 * 255.0 / 65535));
  options.black_white = {2000, 4550};
  expect_ramp(load_image(folder.path() / "deep.png", options), 0, "stated");
  options.black_white = {100, 151};
  const Image grey = load_image(folder.path() / "grey.png", options);
  EXPECT_EQ(grey.at(90, 10), 0);
  EXPECT_EQ(grey.at(110, 10), 50);
  EXPECT_EQ(grey.at(160, 10), 255);
  options.black_white = {5, 5};
  expect_input_error([&] { options.validate(); }, {"image_range", "black below white"});
}

TEST(LoadImage, LeavesWhatIsNoNumberBlack) {
  const TemporaryFolder folder;
  cv::Mat real = ramp(CV_32F, 1 / 255.0);
  real.at<float>(3, 200) = NAN;
  real.at<float>(4, 200) = INFINITY;
  real.at<float>(5, 200) = -INFINITY;
  cv::imwrite((folder.path() / "real.tif").string(), real);
  CollectedLog log;
  const Image image = load_image(folder.path() / "real.tif");
  expect_ramp(image, 0, "around");
  EXPECT_EQ(image.at(200, 3), 0);
  EXPECT_EQ(image.at(200, 4), 255);
  EXPECT_EQ(image.at(200, 5), 0);
  cv::imwrite((folder.path() / "none.tif").string(), cv::Mat(20, 20, CV_32F, cv::Scalar(NAN)));
  expect_input_error([&] { load_image(folder.path() / "none.tif"); },
                     {"none.tif", "pixels", "none that is finite"});
}

}  // namespace
}  // namespace edgescout::test
