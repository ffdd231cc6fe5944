#include "kernels/edge_detect.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>

#include "kernels/edge_stages.h"
#include "kernels/error.h"
#include "kernels/thread_pool.h"

namespace edgescout {
namespace {

constexpr double pi = std::numbers::pi;

struct Picture {
  int width, height;
  std::vector<std::uint8_t> pixels;
  ImageView view() const { return {width, height, pixels.data()}; }
  int at(int x, int y) const {
    return pixels[std::clamp(y, 0, height - 1) * width + std::clamp(x, 0, width - 1)];
  }
};

Picture noise_picture(int width, int height, unsigned seed) {
  std::mt19937 rng(seed);
  Picture picture{width, height, {}};
  for (int i = 0; i < width * height; ++i)
    picture.pixels.push_back(static_cast<std::uint8_t>(rng() & 255));
  return picture;
}

// Discs and bars: edges of every direction, contrast and curvature, touching the border.
Picture shapes_picture(int width, int height, unsigned seed) {
  std::mt19937 rng(seed);
  std::uniform_real_distribution<double> unit(0, 1);
  std::vector<double> grey(width * height, 90);
  for (int k = 0; k < 12; ++k) {
    const double cx = unit(rng) * width, cy = unit(rng) * height, r = 3 + unit(rng) * width / 4,
                 a = unit(rng) * pi, level = unit(rng) * 255;
    for (int y = 0; y < height; ++y)
      for (int x = 0; x < width; ++x) {
        const double u = (x - cx) * std::cos(a) + (y - cy) * std::sin(a),
                     v = -(x - cx) * std::sin(a) + (y - cy) * std::cos(a);
        const double inside =
            k % 2 ? r - std::hypot(u, v) : std::min(r - std::abs(u), r / 3 - std::abs(v));
        const double cover = std::clamp(inside + 0.5, 0.0, 1.0);
        grey[y * width + x] += cover * (level - grey[y * width + x]);
      }
  }
  std::normal_distribution<double> noise(0, 2);
  Picture picture{width, height, {}};
  for (double g : grey)
    picture.pixels.push_back(
        static_cast<std::uint8_t>(std::clamp(std::round(g + noise(rng)), 0.0, 255.0)));
  return picture;
}

double angle_between(double a, double b) {
  const double d = std::abs(a - b);
  return std::min(d, pi - d);
}

using Size = std::pair<int, int>;
class EdgeStages : public testing::TestWithParam<Size> {
 protected:
  int width = GetParam().first, height = GetParam().second;
  std::size_t size = std::size_t(width) * height;
};

TEST_P(EdgeStages, GradientIsTheConvolutionWithAGaussianDerivative) {
  const Picture picture = noise_picture(width, height, 3);
  for (float sigma : {0.3f, 1.0f, 2.3f}) {
    const auto gradient = edge_gradient_reference(picture.view(), edge_weights(sigma));
    const int radius = std::max(1, static_cast<int>(std::ceil(3 * sigma)));
    const auto gauss = [&](int i) { return std::exp(-0.5 * i * i / (double(sigma) * sigma)); };
    double sum = 0, slope = 0;
    for (int i = -radius; i <= radius; ++i) sum += gauss(i), slope += i * i * gauss(i);
    for (int y = 0; y < height; ++y)
      for (int x = 0; x < width; ++x) {
        double gx = 0, gy = 0;
        for (int j = -radius; j <= radius; ++j)
          for (int i = -radius; i <= radius; ++i) {
            gx += gauss(j) / sum * i * gauss(i) / slope * picture.at(x + i, y + j);
            gy += gauss(i) / sum * j * gauss(j) / slope * picture.at(x + i, y + j);
          }
        const std::size_t p = 2 * (std::size_t(y) * width + x);
        EXPECT_NEAR(gradient[p] / double(EDGE_GRADIENT_SCALE), gx, 0.03)
            << x << " " << y << " sigma " << sigma;
        EXPECT_NEAR(gradient[p + 1] / double(EDGE_GRADIENT_SCALE), gy, 0.03)
            << x << " " << y << " sigma " << sigma;
      }
  }
}

// The rule of edge_thin in other words: by compass direction, in 64 bits.
bool ridge_by_compass(const std::vector<std::int16_t>& g, int width, int x, int y,
                      std::int64_t low) {
  static constexpr int compass[8][2] = {{1, 0},  {1, 1},   {0, 1},  {-1, 1},
                                        {-1, 0}, {-1, -1}, {0, -1}, {1, -1}};
  const auto m2 = [&](int qx, int qy) {
    const std::int64_t a = g[2 * (qy * width + qx)], b = g[2 * (qy * width + qx) + 1];
    return a * a + b * b;
  };
  if (m2(x, y) < low * low) return false;
  const std::int64_t gx = g[2 * (y * width + x)], gy = g[2 * (y * width + x) + 1];
  int axis = std::abs(gx) >= std::abs(gy) ? (gx < 0 ? 4 : 0) : (gy < 0 ? 6 : 2), diagonal = axis;
  for (int k : {1, 3, 5, 7})
    if (compass[k][0] * gx >= 0 && compass[k][1] * gy >= 0 && (compass[k][0] > 0 || gx < 0) &&
        (compass[k][1] > 0 || gy < 0))
      diagonal = k;
  const std::int64_t m = std::max(std::abs(gx), std::abs(gy)),
                     n = std::min(std::abs(gx), std::abs(gy)), f = (256 * n + m / 2) / m;
  const auto ring = [&](int turn) {
    const auto& a = compass[(axis + turn) % 8];
    const auto& d = compass[(diagonal + turn) % 8];
    return (256 - f) * (m2(x + a[0], y + a[1]) / 64) + f * (m2(x + d[0], y + d[1]) / 64);
  };
  const std::int64_t centre = 256 * (m2(x, y) / 64);
  return centre > ring(4) && centre >= ring(0);
}

TEST_P(EdgeStages, ThinningKeepsTheRidgesOfTheGradient) {
  std::mt19937 rng(9);
  for (int range : {3, 300, 16320}) {
    std::uniform_int_distribution<int> value(-range, range);
    std::vector<std::int16_t> gradient;
    for (std::size_t i = 0; i < 2 * size; ++i)
      gradient.push_back(static_cast<std::int16_t>(value(rng)));
    const int low = std::max(1, range / 3);
    const auto candidates = edge_thin_reference(gradient, width, height, low);
    for (int y = 0; y < height; ++y)
      for (int x = 0; x < width; ++x) {
        const bool inner = x > 0 && y > 0 && x < width - 1 && y < height - 1;
        EXPECT_EQ(candidates[y * width + x] != 0,
                  inner && ridge_by_compass(gradient, width, x, y, low))
            << x << " " << y;
      }
  }
}

TEST_P(EdgeStages, LinkingKeepsWholeComponents) {
  std::mt19937 rng(11);
  std::vector<std::int16_t> gradient;
  std::vector<std::uint8_t> candidates;
  for (std::size_t i = 0; i < size; ++i) {
    candidates.push_back(rng() % 3 == 0);
    gradient.push_back(static_cast<std::int16_t>(rng() % 1000));
    gradient.push_back(static_cast<std::int16_t>(rng() % 1000));
  }
  // Labels sink until nothing changes.
  std::vector<std::size_t> label(size);
  for (std::size_t i = 0; i < size; ++i) label[i] = i;
  for (bool changed = true; changed;) {
    changed = false;
    for (int y = 0; y < height; ++y)
      for (int x = 0; x < width; ++x)
        for (int qy = std::max(0, y - 1); qy < std::min(height, y + 2); ++qy)
          for (int qx = std::max(0, x - 1); qx < std::min(width, x + 2); ++qx) {
            const std::size_t p = y * width + x, q = qy * width + qx;
            if (!candidates[p] || !candidates[q] || label[q] >= label[p]) continue;
            label[p] = label[q];
            changed = true;
          }
  }
  const int high = 1200, length = 4;
  std::vector<int> count(size), strong(size);
  for (std::size_t i = 0; i < size; ++i) {
    count[label[i]] += candidates[i];
    strong[label[i]] |= candidates[i] && std::hypot(gradient[2 * i], gradient[2 * i + 1]) >= high;
  }
  const auto kept = edge_link_reference(gradient, candidates, width, height, high, length);
  for (std::size_t i = 0; i < size; ++i)
    EXPECT_EQ(kept[i] != 0, candidates[i] && count[label[i]] >= length && strong[label[i]]) << i;
}

void expect_same_points(const std::vector<EdgePoint>& a, const std::vector<EdgePoint>& b) {
  ASSERT_EQ(a.size(), b.size());
  for (std::size_t i = 0; i < a.size(); ++i) {
    EXPECT_NEAR(a[i].x_px, b[i].x_px, 1e-3) << i;
    EXPECT_NEAR(a[i].y_px, b[i].y_px, 1e-3) << i;
    EXPECT_LT(angle_between(a[i].theta_rad, b[i].theta_rad), 1e-3) << i;
    EXPECT_NEAR(a[i].strength, b[i].strength, 1e-5 * a[i].strength) << i;
  }
}

TEST_P(EdgeStages, FastPathEqualsReference) {
  ThreadPool pool(3);
  for (const Picture& picture : {noise_picture(width, height, 5), shapes_picture(width, height, 6)})
    for (float sigma : {0.4f, 1.0f, 3.0f}) {
      const EdgeWeights weights = edge_weights(sigma);
      const auto gradient = edge_gradient_reference(picture.view(), weights);
      const auto candidates = edge_thin_reference(gradient, width, height, 200);
      EdgePlanes planes(width, height);
      edge_gradient_fast(picture.view(), weights, pool, planes);
      const auto listed = edge_thin_fast(200, pool, planes);
      std::size_t total = 0;
      for (std::size_t i = 0; i < size; ++i) {
        ASSERT_EQ(gradient[2 * i], planes.gx[i]) << i << " sigma " << sigma;
        ASSERT_EQ(gradient[2 * i + 1], planes.gy[i]) << i << " sigma " << sigma;
        ASSERT_EQ(candidates[i],
                  planes.candidates[planes.candidate_index(int(i) % width, int(i) / width)])
            << i;
        total += candidates[i];
      }
      ASSERT_EQ(listed.size(), total);
      EdgeOptions options;
      options.sigma_px = sigma;
      options.min_length_px = 3;
      expect_same_points(detect_edges_reference(picture.view(), options),
                         detect_edges_fast(picture.view(), options, pool));
    }
}

INSTANTIATE_TEST_SUITE_P(Sizes, EdgeStages,
                         testing::Values(Size{1, 1}, Size{7, 5}, Size{3, 3}, Size{2, 9}, Size{9, 2},
                                         Size{33, 31}, Size{141, 67}, Size{19, 110}));

TEST(EdgeWeightsTest, FlatImagesAndRampsAreAnsweredExactly) {
  for (float sigma : {0.3f, 0.7f, 1.0f, 1.5f, 2.0f, 4.0f, 8.0f}) {
    const EdgeWeights w = edge_weights(sigma);
    int sum = w.smooth[0], slope = 0;
    for (int i = 1; i <= w.radius; ++i) sum += 2 * w.smooth[i], slope += 2 * i * w.derivative[i];
    EXPECT_EQ(sum, 16384);
    EXPECT_EQ(slope, 16384);
    EXPECT_EQ(w.derivative[0], 0);
  }
}

TEST(EdgeDetect, ExtremeContrastStaysInRange) {
  // Black beside white, at the smallest sigma: the largest numbers there are.
  Picture picture{16, 16, std::vector<std::uint8_t>(256, 0)};
  for (int y = 0; y < 16; ++y)
    for (int x = 0; x < 16; ++x) picture.pixels[y * 16 + x] = x + y > 15 ? 255 : 0;
  EdgeOptions options;
  options.sigma_px = 0.3f;
  ThreadPool pool(2);
  const auto points = detect_edges_reference(picture.view(), options);
  ASSERT_FALSE(points.empty());
  for (const EdgePoint& p : points) {
    EXPECT_LT(angle_between(p.theta_rad, 3 * pi / 4), 0.01);
    EXPECT_NEAR((p.x_px + p.y_px - 15.5) / std::numbers::sqrt2, 0, 0.4);
  }
  expect_same_points(points, detect_edges_fast(picture.view(), options, pool));
}

TEST(EdgeDetect, PointsComeRowByRowOncePerPixel) {
  const Picture picture = shapes_picture(90, 70, 21);
  const auto points = detect_edges_reference(picture.view(), {});
  ASSERT_GT(points.size(), 100u);
  int last = -1;
  for (const EdgePoint& p : points) {
    EXPECT_GE(p.theta_rad, 0.0f);
    EXPECT_LT(p.theta_rad, std::numbers::pi_v<float>);
    // The pixel lies within half a pixel; rows never run backwards by more than that.
    EXPECT_GE(p.y_px, last - 0.5f);
    last = std::max(last, static_cast<int>(std::floor(p.y_px)));
  }
}

TEST(EdgeDetect, FlatImagesHaveNoEdges) {
  const Picture flat{40, 30, std::vector<std::uint8_t>(1200, 255)};
  ThreadPool pool(2);
  EXPECT_TRUE(detect_edges_reference(flat.view(), {}).empty());
  EXPECT_TRUE(detect_edges_fast(flat.view(), {}, pool).empty());
}

TEST(EdgeDetect, BadOptionsNameTheField) {
  const Picture flat{4, 4, std::vector<std::uint8_t>(16, 0)};
  ThreadPool pool(1);
  const auto expect_bad = [&](EdgeOptions options, const char* field) {
    try {
      detect_edges_fast(flat.view(), options, pool);
      ADD_FAILURE() << field << " was accepted";
    } catch (const InputError& error) {
      EXPECT_NE(std::string(error.what()).find(field), std::string::npos) << error.what();
    }
    EXPECT_THROW(detect_edges_reference(flat.view(), options), InputError);
  };
  expect_bad({.sigma_px = 0}, "edge.sigma");
  expect_bad({.sigma_px = 8.1f}, "edge.sigma");
  expect_bad({.sigma_px = std::nanf("")}, "edge.sigma");
  expect_bad({.low_threshold = 0}, "edge.low_threshold");
  expect_bad({.low_threshold = 6, .high_threshold = 5}, "edge.high_threshold");
  expect_bad({.high_threshold = 128}, "edge.high_threshold");
  expect_bad({.min_length_px = 0}, "edge.min_length");
  EXPECT_THROW(detect_edges_fast({}, {}, pool), LogicError);
  EXPECT_THROW(detect_edges_reference({}, {}), LogicError);
}

}  // namespace
}  // namespace edgescout
