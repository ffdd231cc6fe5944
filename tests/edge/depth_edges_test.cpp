#include "host/edge/depth_edges.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

#include "tests/test_random.h"

namespace edgescout::test {
namespace {

constexpr int width_px = 160, height_px = 120;

// Boxes on a plane, as a depth camera sees them and as edges.
struct Boxes {
  DepthImage depth{width_px, height_px, std::vector<float>(width_px* height_px, 0.6f)};
  std::vector<EdgePoint> edges;

  explicit Boxes(Random& random) {
    for (int i = 0; i < 8; ++i)
      add(int(random.uniform(5, 110)), int(random.uniform(5, 80)), int(random.uniform(15, 40)),
          int(random.uniform(15, 30)), float(random.uniform(0.5, 0.58)));
    for (int i = 0; i < 300; ++i)  // texture
      edges.push_back(
          {float(random.uniform(0, width_px - 1)), float(random.uniform(0, height_px - 1)), 0, 50});
  }
  void add(int x0, int y0, int w, int h, float z_m) {
    for (int y = y0; y < y0 + h; ++y)
      for (int x = x0; x < x0 + w; ++x) {
        float& there_m = depth.z_m[std::size_t(y) * std::size_t(width_px) + std::size_t(x)];
        there_m = std::min(there_m, z_m);
        if (x == x0 || x == x0 + w - 1 || y == y0 || y == y0 + h - 1)
          edges.push_back({float(x), float(y), 0, 50});
      }
  }
  DepthImage moved(int dx, int dy) const {
    DepthImage result = depth;
    for (int y = 0; y < height_px; ++y)
      for (int x = 0; x < width_px; ++x)
        result.z_m[std::size_t(y) * std::size_t(width_px) + std::size_t(x)] =
            depth.at(std::clamp(x - dx, 0, width_px - 1), std::clamp(y - dy, 0, height_px - 1));
    return result;
  }
};

TEST(DepthEdges, OfTheSameFrameFit) {
  Random random = test_random();
  Boxes boxes(random);
  for (float& z_m : boxes.depth.z_m)  // noise, a third is missing, biased, in another unit
    z_m = random.uniform() < 0.33 ? 0 : 10 * (z_m + 0.005f + float(random.uniform(0, 1e-3)));
  const DepthEdges found = compare_depth_edges(boxes.depth, {}, boxes.edges);
  EXPECT_EQ(found.fit, DepthFit::Fits);
  EXPECT_GT(found.in_place, 0.8);
  EXPECT_LT(found.by_chance, 0.6);
}

TEST(DepthEdges, OfAWrongPoseAreMoved) {
  Random random = test_random();
  const Boxes boxes(random);
  const DepthEdges found = compare_depth_edges(boxes.moved(-8, 6), {}, boxes.edges);
  EXPECT_EQ(found.fit, DepthFit::Moved);
  EXPECT_NEAR(found.dx_px, 8, 2);
  EXPECT_NEAR(found.dy_px, -6, 2);
}

TEST(DepthEdges, OfAnotherFrameLieElsewhere) {
  Random random = test_random();
  const Boxes boxes(random), others(random);
  EXPECT_EQ(compare_depth_edges(others.depth, {}, boxes.edges).fit, DepthFit::Elsewhere);
}

TEST(DepthEdges, SayNothingOfAPlaneNorOfTextureEverywhere) {
  Random random = test_random();
  Boxes boxes(random);
  const DepthImage plane{width_px, height_px, std::vector<float>(width_px * height_px, 0.6f)};
  EXPECT_EQ(compare_depth_edges(plane, {}, boxes.edges).fit, DepthFit::Unknown);
  EXPECT_EQ(compare_depth_edges(boxes.depth, {}, {}).fit, DepthFit::Unknown);
  // A sensor whose noise is as large as the steps shows no jumps.
  EXPECT_EQ(compare_depth_edges(boxes.depth, {.floor_m = 0.05}, boxes.edges).jumps, 0u);
}

}  // namespace
}  // namespace edgescout::test
