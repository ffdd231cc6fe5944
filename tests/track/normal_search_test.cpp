#include "host/track/normal_search.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "host/core/lens.h"

namespace edgescout {
namespace {

const Camera camera{200, 160, 300, 300, 99.5, 79.5, {}};
const Se3 pose{Eigen::Quaterniond::Identity(), {0, 0, 1}};

// A model edge through the pixel (u, v), along the direction.
ModelPoint point_at(double u, double v, double along_rad) {
  return {float((u - camera.cx) / camera.fx), float((v - camera.cy) / camera.fy), 0,
          float(std::cos(along_rad)),         float(std::sin(along_rad)),         0};
}

// Grey rises across the line n x = distance from `dark` to `bright`, over about a pixel.
void add_step(Image& image, double normal_rad, double distance_px, double by) {
  for (int y = 0; y < image.height; ++y)
    for (int x = 0; x < image.width; ++x) {
      const double s = x * std::cos(normal_rad) + y * std::sin(normal_rad) - distance_px;
      auto& pixel = image.pixels[std::size_t(y) * std::size_t(image.width) + std::size_t(x)];
      pixel = std::uint8_t(std::lround(pixel + by / (1 + std::exp(-4 * s))));
    }
}
Image flat() { return {200, 160, std::vector<std::uint8_t>(200 * 160, 60)}; }

std::vector<LineEdge> edges_at(const Image& image, const ModelPoint& point, double reach_px = 8) {
  const NormalSearch search =
      search_normals(searched(image, camera), pose, {&point, 1}, {}, {reach_px, 3});
  return search.edges;
}

TEST(NormalSearch, FindsAnEdgeToATenthOfAPixelInEveryDirection) {
  for (double normal = 0; normal < 2 * std::numbers::pi; normal += 0.37)
    for (const double offset : {-5.3, -0.25, 2.0, 6.6}) {
      Image image = flat();
      const double u = 101.3, v = 77.7;
      add_step(image, normal, u * std::cos(normal) + v * std::sin(normal) + offset, 80);
      const ModelPoint point = point_at(u, v, normal - std::numbers::pi / 2);
      const std::vector<LineEdge> edges = edges_at(image, point);
      ASSERT_EQ(edges.size(), 1u) << normal << " " << offset;
      EXPECT_NEAR(edges[0].offset_px, offset, 0.1) << normal;
      EXPECT_GT(edges[0].contrast, 5) << normal;
    }
}

TEST(NormalSearch, FindsAllEdgesOfALineWithTheirSigns) {
  Image image = flat();
  add_step(image, 0, 96, 100);
  add_step(image, 0, 103, -60);
  const std::vector<LineEdge> edges = edges_at(image, point_at(100, 80, -std::numbers::pi / 2));
  ASSERT_EQ(edges.size(), 2u);
  EXPECT_NEAR(edges[0].offset_px, -4, 0.15);
  EXPECT_GT(edges[0].contrast, 0);
  EXPECT_NEAR(edges[1].offset_px, 3, 0.15);
  EXPECT_LT(edges[1].contrast, 0);
}

TEST(NormalSearch, FindsNothingBeyondItsReachOrBelowItsContrast) {
  Image image = flat();
  add_step(image, 0, 109.5, 100);
  const ModelPoint point = point_at(100, 80, std::numbers::pi / 2);
  EXPECT_TRUE(edges_at(image, point, 8).empty());
  EXPECT_EQ(edges_at(image, point, 12).size(), 1u);
  Image faint = flat();
  add_step(faint, 0, 101, 5);
  EXPECT_TRUE(edges_at(faint, point).empty());
}

TEST(NormalSearch, LeavesOutPointsWhoseLinesLeaveTheImage) {
  const Image image = flat();
  const std::vector<ModelPoint> points{point_at(4, 80, 1.57), point_at(100, 80, 1.57),
                                       point_at(300, 80, 1.57), point_at(100, 156, 0)};
  const NormalSearch search = search_normals(searched(image, camera), pose, points, {}, {8, 3});
  ASSERT_EQ(search.points.size(), 1u);
  EXPECT_NEAR(search.points[0].u_px, 100, 1e-3);
}

TEST(NormalSearch, SearchesFarInTheImageOfHalfTheSize) {
  Image image = flat();
  add_step(image, 0, 120, 100);
  Image half{100, 80, {}};
  for (int y = 0; y < 80; ++y)
    for (int x = 0; x < 100; ++x)
      half.pixels.push_back(
          std::uint8_t((image.at(2 * x, 2 * y) + image.at(2 * x + 1, 2 * y)) / 2));
  const ModelPoint point = point_at(100, 80, -std::numbers::pi / 2);
  const SearchedImage reduced{&half, camera, camera, 2};
  const NormalSearch search = search_normals(reduced, pose, {&point, 1}, {}, {24, 3});
  ASSERT_EQ(search.edges.size(), 1u);
  EXPECT_NEAR(search.edges[0].offset_px, 20, 0.3);
}

// The image of a lens: the search is given the distorted image, its distances are of the ideal one.
TEST(NormalSearch, FollowsTheLens) {
  Camera lens = camera;
  lens.distortion = {-0.35, 0.12, 0.002, -0.001};
  const double u_px = 160, offset_px = 3;
  Image image{200, 160, {}};
  const double edge_x = (u_px + offset_px - camera.cx) / camera.fx;
  for (int y = 0; y < 160; ++y)
    for (int x = 0; x < 200; ++x) {
      // The direction that this pixel sees, by a fixed point.
      Eigen::Vector2d direction((x - lens.cx) / lens.fx, (y - lens.cy) / lens.fy);
      const Eigen::Vector2d seen = direction;
      for (int i = 0; i < 30; ++i) direction += seen - distorted(lens, direction);
      image.pixels.push_back(std::uint8_t(
          std::lround(60 + 80 / (1 + std::exp(-4 * (direction.x() - edge_x) * lens.fx)))));
    }
  for (const double v_px : {20.0, 80.0, 130.0}) {
    const ModelPoint point = point_at(u_px, v_px, -std::numbers::pi / 2);
    const NormalSearch search =
        search_normals(searched(image, lens), pose, {&point, 1}, {}, {8, 3});
    ASSERT_EQ(search.edges.size(), 1u) << v_px;
    EXPECT_NEAR(search.edges[0].offset_px, offset_px, 0.2) << v_px;
  }
}

TEST(NormalSearch, ContrastsAreThoseThatTheSearchFinds) {
  Image image = flat();
  add_step(image, 0, 100, 70);
  const ModelPoint point = point_at(100, 80, -std::numbers::pi / 2);
  const std::vector<float> contrasts = contrasts_at(searched(image, camera), pose, {&point, 1});
  EXPECT_NEAR(contrasts[0], edges_at(image, point)[0].contrast, 1.5);
}

}  // namespace
}  // namespace edgescout
