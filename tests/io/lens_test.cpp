// The lens models, judged by OpenCV's projections and by formulas written out.
#include "host/core/lens.h"

#include <gtest/gtest.h>

#include <cmath>
#include <opencv2/calib3d.hpp>

#include "tests/test_random.h"

namespace edgescout::test {
namespace {

constexpr double tolerance_px = 1e-9;

Camera with_lens(LensModel lens, const LensCoefficients& coefficients) {
  Camera camera{640, 480, 500, 510, 322, 236, coefficients};
  camera.lens = lens;
  return camera;
}

cv::Matx33d matrix_of(const Camera& c) { return {c.fx, 0, c.cx, 0, c.fy, c.cy, 0, 0, 1}; }

void expect_as_opencv(const Camera& camera, int coefficients, bool is_fisheye) {
  Random random = test_random();
  std::vector<cv::Point3d> points;
  for (int i = 0; i < 200; ++i)
    points.emplace_back(random.uniform(-0.6, 0.6), random.uniform(-0.5, 0.5), 1.0);
  const std::vector<double> distortion(camera.distortion.begin(),
                                       camera.distortion.begin() + coefficients);
  std::vector<cv::Point2d> seen;
  const cv::Vec3d none(0, 0, 0);
  if (is_fisheye)
    cv::fisheye::projectPoints(points, seen, none, none, matrix_of(camera), distortion,
                               camera.skew / camera.fx);
  else
    cv::projectPoints(points, none, none, matrix_of(camera), distortion, seen);
  for (std::size_t i = 0; i < points.size(); ++i) {
    const Eigen::Vector2d ours = pixel_seeing(camera, {points[i].x, points[i].y});
    EXPECT_NEAR(ours.x(), seen[i].x, tolerance_px) << i;
    EXPECT_NEAR(ours.y(), seen[i].y, tolerance_px) << i;
  }
}

TEST(Lens, AgreesWithOpenCvFromFourToFourteenCoefficients) {
  const LensCoefficients all{-0.25, 0.12,  0.001, -0.002, 0.02,  0.01, -0.02,
                             0.005, 0.003, 0.001, -0.002, 0.004, 0.02, -0.03};
  for (const int count : {4, 5, 8, 12, 14}) {
    LensCoefficients some = all;
    std::fill(some.begin() + count, some.end(), 0);
    expect_as_opencv(with_lens(LensModel::BrownConrady, some), count, false);
  }
}

TEST(Lens, AgreesWithOpenCvsFisheyeAlsoWithSkew) {
  Camera camera = with_lens(LensModel::Fisheye, {-0.03, 0.01, -0.005, 0.001});
  expect_as_opencv(camera, 4, true);
  camera.skew = 1.5;
  expect_as_opencv(camera, 4, true);
}

// librealsense's rsutil.h: the tangential terms see the point that the radial terms moved.
TEST(Lens, ModifiedBrownConradyByHand) {
  const Camera camera = with_lens(LensModel::ModifiedBrownConrady, {0.1, 0.2, 0.01, 0.02, 0.3});
  const double x = 0.3, y = -0.2, r2 = x * x + y * y,
               f = 1 + 0.1 * r2 + 0.2 * r2 * r2 + 0.3 * r2 * r2 * r2, u = x * f, v = y * f;
  const Eigen::Vector2d expected(u + 2 * 0.01 * u * v + 0.02 * (r2 + 2 * u * u),
                                 v + 2 * 0.02 * u * v + 0.01 * (r2 + 2 * v * v));
  EXPECT_NEAR((distorted(camera, {x, y}) - expected).norm(), 0, 1e-15);
}

TEST(Lens, FieldOfViewByHand) {
  const double omega = 0.9;
  const Camera camera = with_lens(LensModel::FieldOfView, {omega});
  const Eigen::Vector2d seen = distorted(camera, {0.3, 0.4});
  const double radius = std::atan(2 * 0.5 * std::tan(omega / 2)) / omega;
  EXPECT_NEAR((seen - radius * Eigen::Vector2d(0.6, 0.8)).norm(), 0, 1e-15);
  EXPECT_EQ(distorted(camera, {0, 0}), Eigen::Vector2d(0, 0));
}

// COLMAP's THIN_PRISM_FISHEYE on (theta x / r, theta y / r).
TEST(Lens, ThinPrismFisheyeByHand) {
  const Camera camera =
      with_lens(LensModel::ThinPrismFisheye, {0.1, 0.02, 0.003, 0.004, 0.05, 0.06, 0.007, 0.008});
  const double theta = std::atan(0.5), u = 0.6 * theta, v = 0.8 * theta, r2 = theta * theta;
  const double radial = r2 * (0.1 + r2 * (0.02 + r2 * (0.05 + r2 * 0.06)));
  const Eigen::Vector2d expected(
      u + u * radial + 2 * 0.003 * u * v + 0.004 * (r2 + 2 * u * u) + 0.007 * r2,
      v + v * radial + 2 * 0.004 * u * v + 0.003 * (r2 + 2 * v * v) + 0.008 * r2);
  EXPECT_NEAR((distorted(camera, {0.3, 0.4}) - expected).norm(), 0, 1e-15);
}

// Aria's FISHEYE624: uv = m + 2 (m . p) m + |m|^2 p + prism, m the radially moved point.
TEST(Lens, FisheyeWithTangentialAndPrismByHand) {
  const Camera camera = with_lens(LensModel::Fisheye, {0.1, 0.02, 0.03, 0.04, 0.05, 0.06, 0.007,
                                                       0.008, 0.009, 0.01, 0.011, 0.012});
  const double theta = std::atan(0.5), t2 = theta * theta;
  const double th =
      theta * (1 + t2 * (0.1 + t2 * (0.02 + t2 * (0.03 + t2 * (0.04 + t2 * (0.05 + t2 * 0.06))))));
  const Eigen::Vector2d m = th * Eigen::Vector2d(0.6, 0.8), p(0.007, 0.008);
  const double m2 = m.squaredNorm();
  const Eigen::Vector2d expected =
      m + 2 * m.dot(p) * m + m2 * p +
      Eigen::Vector2d(0.009 * m2 + 0.01 * m2 * m2, 0.011 * m2 + 0.012 * m2 * m2);
  EXPECT_NEAR((distorted(camera, {0.3, 0.4}) - expected).norm(), 0, 1e-15);
}

TEST(Lens, FoldsWhereTheRadiusTurnsBack) {
  // d/dr (r + k1 r^3) = 0 at r = 1 / sqrt(-3 k1).
  Camera camera = with_lens(LensModel::BrownConrady, {-1.5});
  const std::optional<double> fold = folds_at_px(camera);
  ASSERT_TRUE(fold);
  EXPECT_NEAR(*fold, 500 / std::sqrt(4.5), 12);  // the grid's step
  camera.distortion[0] = -0.25;
  EXPECT_FALSE(folds_at_px(camera));
  EXPECT_FALSE(folds_at_px(with_lens(LensModel::Fisheye, {-0.03, 0.01, -0.005, 0.001})));
}

}  // namespace
}  // namespace edgescout::test
