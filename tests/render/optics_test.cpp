#include "host/render/optics.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "tests/render/lights.h"

namespace edgescout::test {
namespace {

Camera camera_of(int width, int height) {
  Camera camera;
  camera.width = width;
  camera.height = height;
  camera.fx = camera.fy = 200;
  camera.cx = 0.5 * (width - 1);
  camera.cy = 0.5 * (height - 1);
  return camera;
}

// Half dark, half light, with the edge between columns `column - 1` and `column`.
cv::Mat step(int width, int height, int column) {
  cv::Mat light = even_light(width, height, 0);
  light.colRange(column, width).setTo(1);
  return light;
}

// Mean position and standard deviation of the light, px.
struct Spot {
  Eigen::Vector2d at = Eigen::Vector2d::Zero();
  double sigma_x = 0, sigma_y = 0, sum = 0;
};

Spot spot_of(const cv::Mat& light) {
  Spot spot;
  Eigen::Vector2d squares = Eigen::Vector2d::Zero();
  for (int y = 0; y < light.rows; ++y)
    for (int x = 0; x < light.cols; ++x) {
      const double weight = light.at<float>(y, x);
      spot.sum += weight;
      spot.at += weight * Eigen::Vector2d(x, y);
      squares += weight * Eigen::Vector2d(x * x, y * y);
    }
  spot.at /= spot.sum;
  spot.sigma_x = std::sqrt(std::max(0.0, squares.x() / spot.sum - spot.at.x() * spot.at.x()));
  spot.sigma_y = std::sqrt(std::max(0.0, squares.y() / spot.sum - spot.at.y() * spot.at.y()));
  return spot;
}

cv::Mat point(int width, int height, int x, int y) {
  cv::Mat light = even_light(width, height, 0);
  light.at<float>(y, x) = 1;
  return light;
}

TEST(DistortRadially, MovesAPointByTheCubeOfItsDistance) {
  const Camera camera = camera_of(201, 151);
  const double corner = std::hypot(100, 75);
  for (const double corner_px : {2.0, -1.5}) {
    cv::Mat light = point(201, 151, 160, 115);  // (60, 40) from the centre
    distort_radially(light, camera, corner_px);
    const double distance = std::hypot(60, 40), shift = corner_px * std::pow(distance / corner, 3);
    const Spot spot = spot_of(light);
    EXPECT_NEAR(spot.at.x(), 160 + shift * 60 / distance, 0.05) << corner_px;
    EXPECT_NEAR(spot.at.y(), 115 + shift * 40 / distance, 0.05) << corner_px;
  }
}

TEST(DistortRadially, LeavesTheCentreAndAnEvenImage) {
  const Camera camera = camera_of(201, 151);
  cv::Mat light = even_light(201, 151, 0.5);
  distort_radially(light, camera, 4);
  EXPECT_LT(cv::norm(light, even_light(201, 151, 0.5), cv::NORM_INF), 1e-6);
  light = point(201, 151, 100, 75);
  distort_radially(light, camera, 4);
  EXPECT_NEAR(light.at<float>(75, 100), 1, 1e-4);
}

TEST(Defocus, SpreadsAPointEvenlyOverADisc) {
  cv::Mat light = point(61, 61, 30, 30);
  defocus(light, 6);
  const Spot spot = spot_of(light);
  EXPECT_NEAR(spot.sum, 1, 1e-5);
  EXPECT_NEAR(spot.sigma_x, 6 / 2.0, 0.15);  // of a disc: half its radius
  EXPECT_NEAR(light.at<float>(30, 30), light.at<float>(30, 34), 1e-6);
  EXPECT_NEAR(light.at<float>(30, 37), 0, 1e-9);
}

// An edge blurred by a disc rises from 0 to 1 over its diameter.
TEST(Defocus, WidensAnEdgeToItsDiameter) {
  cv::Mat light = step(61, 41, 30);
  defocus(light, 5);
  EXPECT_LT(light.at<float>(20, 29 - 5), 0.01);
  EXPECT_GT(light.at<float>(20, 30 + 5), 0.99);
  EXPECT_GT(light.at<float>(20, 29 - 3), 0.05);
  EXPECT_NEAR(light.at<float>(20, 29) + light.at<float>(20, 30), 1, 1e-4);
}

TEST(BlurByMotion, SpreadsAPointAlongItsDirectionAlone) {
  cv::Mat light = point(61, 61, 30, 30);
  blur_by_motion(light, 12, 0);
  Spot spot = spot_of(light);
  EXPECT_NEAR(spot.at.x(), 30, 1e-3);
  EXPECT_NEAR(spot.sigma_x, 12 / std::sqrt(12.0), 0.15);
  EXPECT_NEAR(spot.sigma_y, 0, 0.05);
  light = point(61, 61, 30, 30);
  blur_by_motion(light, 12, std::numbers::pi / 6);
  spot = spot_of(light);
  EXPECT_NEAR(spot.sigma_y / spot.sigma_x, std::tan(std::numbers::pi / 6), 0.1);
}

TEST(Vignette, DarkensTheCornersByTheShareAndNotTheCentre) {
  cv::Mat light = even_light(101, 61, 0.8);
  vignette(light, 0.4);
  EXPECT_NEAR(light.at<float>(30, 50), 0.8, 1e-6);
  for (const auto& [x, y] : {std::pair{0, 0}, {100, 0}, {0, 60}, {100, 60}})
    EXPECT_NEAR(light.at<float>(y, x), 0.8 * 0.6, 1e-5);
  EXPECT_GT(light.at<float>(30, 80), light.at<float>(30, 90));
}

TEST(ScaleContrast, KeepsTheMeanAndScalesDifferences) {
  cv::Mat light = step(40, 10, 20);
  scale_contrast(light, 0.1);
  EXPECT_NEAR(cv::mean(light)[0], 0.5, 1e-6);
  EXPECT_NEAR(light.at<float>(5, 30) - light.at<float>(5, 10), 0.1, 1e-6);
}

TEST(Optics, DoesNothingAtItsNeutralValues) {
  const cv::Mat before = step(60, 40, 25);
  cv::Mat light = before.clone();
  distort_radially(light, camera_of(60, 40), 0);
  defocus(light, 0);
  blur_by_motion(light, 0, 1);
  vignette(light, 0);
  scale_contrast(light, 1);
  EXPECT_EQ(cv::norm(light, before, cv::NORM_INF), 0);
}

}  // namespace
}  // namespace edgescout::test
