#include "host/render/sensor.h"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/render/lights.h"

namespace edgescout::test {
namespace {

// Standard deviation of the grey levels that noise makes of even light.
double noise_of(double grey, double sigma_grey, double gamma) {
  cv::Mat light = even_light(200, 200, std::pow(grey / 255, gamma));
  add_sensor_noise(light, sigma_grey, gamma, Random(3));
  cv::Scalar mean, sigma;
  cv::meanStdDev(display_curve(light, gamma), mean, sigma);
  return sigma[0];
}

TEST(SensorNoise, HasItsLevelAtMiddleGreyWhateverTheCurve) {
  for (const double gamma : {1.0, 2.2, 2.8}) EXPECT_NEAR(noise_of(128, 4, gamma), 4, 0.15) << gamma;
}

// Without a curve: half the variance is constant, half grows with the light.
TEST(SensorNoise, GrowsWithTheLight) {
  EXPECT_NEAR(noise_of(32, 4, 1), 4 * std::sqrt(0.5 + 0.5 * 32 / 128), 0.15);
  EXPECT_NEAR(noise_of(200, 4, 1), 4 * std::sqrt(0.5 + 0.5 * 200 / 128), 0.2);
}

TEST(DisplayCurve, IsAPowerAndClips) {
  cv::Mat light(1, 4, CV_32F);
  const float values[] = {-0.2f, 0.25f, 1.0f, 7.0f};
  for (int x = 0; x < 4; ++x) light.at<float>(0, x) = values[x];
  for (const double gamma : {1.0, 2.0, 2.2}) {
    const cv::Mat grey = display_curve(light, gamma);
    EXPECT_EQ(grey.at<double>(0, 0), 0);
    EXPECT_NEAR(grey.at<double>(0, 1), 255 * std::pow(0.25, 1 / gamma), 1e-9);
    EXPECT_EQ(grey.at<double>(0, 2), 255);
    EXPECT_EQ(grey.at<double>(0, 3), 255);
  }
}

// Halos on both sides of an edge: over the light side, under the dark side.
TEST(Sharpen, OvershootsAtAnEdgeInProportionToItsAmount) {
  cv::Mat grey(20, 60, CV_64F, cv::Scalar::all(100));
  grey.colRange(30, 60).setTo(150);
  double overshoot[2];
  for (int i = 0; i < 2; ++i) {
    cv::Mat sharp = grey.clone();
    sharpen(sharp, i + 1, 1.5);
    overshoot[i] = sharp.at<double>(10, 30) - 150;
    EXPECT_NEAR(100 - sharp.at<double>(10, 29), overshoot[i], 1e-9);
    EXPECT_NEAR(sharp.at<double>(10, 5), 100, 1e-6);
  }
  EXPECT_GT(overshoot[0], 5);
  EXPECT_NEAR(overshoot[1], 2 * overshoot[0], 1e-9);
}

Image slope() {
  Image image{64, 64, {}};
  for (int y = 0; y < 64; ++y)
    for (int x = 0; x < 64; ++x)
      image.pixels.push_back(static_cast<std::uint8_t>(100 + x / 2 + (x * 7 + y * 13) % 9));
  return image;
}

// Mean step from one column to the next: over the borders of the 8 x 8 blocks, and elsewhere.
std::pair<double, double> steps(const Image& image) {
  double at_borders = 0, elsewhere = 0;
  int borders = 0, others = 0;
  for (int y = 0; y < 64; ++y)
    for (int x = 1; x < 64; ++x) {
      const double step = std::abs(int(image.at(x, y)) - int(image.at(x - 1, y)));
      if (x % 8 == 0)
        at_borders += step, ++borders;
      else
        elsewhere += step, ++others;
    }
  return {at_borders / borders, elsewhere / others};
}

TEST(ThroughJpeg, ShowsItsBlocksAtALowQuality) {
  const auto [at_borders, elsewhere] = steps(through_jpeg(slope(), 5));
  EXPECT_GT(at_borders, 3 * elsewhere);
  const auto [before, others] = steps(slope());
  EXPECT_LT(before, 1.5 * others);
}

TEST(ThroughJpeg, LosesLessAtAHigherQuality) {
  const Image image = slope();
  double previous = 1e9;
  for (const int quality : {10, 50, 95}) {
    double error = 0;
    const Image back = through_jpeg(image, quality);
    ASSERT_EQ(back.pixels.size(), image.pixels.size());
    for (std::size_t i = 0; i < image.pixels.size(); ++i)
      error += std::abs(int(back.pixels[i]) - int(image.pixels[i]));
    EXPECT_LT(error, previous);
    previous = error;
  }
  EXPECT_EQ(through_jpeg(image, 0).pixels, image.pixels);
}

}  // namespace
}  // namespace edgescout::test
