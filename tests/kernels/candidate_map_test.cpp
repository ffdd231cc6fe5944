// candidate_map: its reference against distances in double between the points as given, every path
// against the reference.
#include "kernels/candidate_map.h"

#include "kernels/cases/chamfer_cases.h"
#include "kernels/error.h"
#include "tests/kernels/paths.h"

namespace edgescout {
namespace {

TEST(CandidateMap, StepsAreTheRoundedRootOfEverySquare) {
  for (std::uint32_t d2 = 0; d2 <= CANDIDATE_MAP_REACH2; ++d2)
    ASSERT_EQ(chamfer_steps(d2 << 16 | 7),
              static_cast<std::uint32_t>(std::lround(std::sqrt(double(d2)))))
        << d2;
  EXPECT_EQ(chamfer_steps(CANDIDATE_MAP_EMPTY), CHAMFER_CAP);
  EXPECT_EQ(std::lround(std::sqrt(double(CANDIDATE_MAP_REACH2 + 1))), long(CHAMFER_CAP));
}

TEST(CandidateMap, APixelReachesHalfAPixelAround) {
  int x = -7, y = -7;
  EXPECT_TRUE(nearest_pixel(-0.5f, 3.49f, 10, 8, x, y));
  EXPECT_EQ(x, 0);
  EXPECT_EQ(y, 3);
  EXPECT_TRUE(nearest_pixel(std::nextafter(9.5f, 0.0f), 7.4f, 10, 8, x, y));
  EXPECT_EQ(x, 9);
  EXPECT_EQ(y, 7);
  EXPECT_FALSE(nearest_pixel(9.5f, 3, 10, 8, x, y));
  EXPECT_FALSE(nearest_pixel(3, -0.51f, 10, 8, x, y));
  EXPECT_FALSE(nearest_pixel(NAN, 3, 10, 8, x, y));
}

TEST(CandidateMap, AWindowTakesInAllThatIsInReach) {
  const MapWindow inner = map_window(40.2f, 50.9f, 60.1f, 55, 200, 100);
  EXPECT_EQ(inner.x0, 24);
  EXPECT_EQ(inner.y0, 34);
  EXPECT_EQ(inner.x0 + int(inner.width) - 1, 77);
  EXPECT_EQ(inner.y0 + int(inner.height) - 1, 71);
  const MapWindow cut = map_window(-50, 90, 3, 400, 200, 100);
  EXPECT_EQ(cut.x0, 0);
  EXPECT_EQ(cut.width, 20u);
  EXPECT_EQ(cut.y0 + int(cut.height), 100);
  EXPECT_EQ(map_window(-90, 10, -30, 20, 200, 100).size(), 0u);
}

// By brute force: the least distance to the points as they were given, those outside of the image
// left out.
TEST(CandidateMap, HoldsTheDistanceToTheNearestEdgePoint) {
  std::mt19937 rng = test::test_rng();
  constexpr double rounding = 1.0 / 32 * std::numbers::sqrt2;  // of the points to 1/16 px
  std::size_t within = 0, beyond = 0;
  for (int round = 0; round < 4; ++round) {
    const test::ChamferInput input = test::random_chamfer_input(rng, {70, 50, 9, 40, 0, 0, 1});
    for (const CandidateMap& map : input.maps)
      for (std::size_t i = 0; i < map.window.size(); ++i) {
        const double x = map.window.x0 + int(i % map.window.width),
                     y = map.window.y0 + int(i / map.window.width);
        double least = 1e9;
        const auto distance_to = [&](const MapEdge& e) {
          return std::hypot(e.x_px - x, e.y_px - y);
        };
        for (std::uint32_t e = 0; e < map.edge_count; ++e) {
          const MapEdge& edge = input.edges[map.first_edge + e];
          if (edge.x_px >= -0.5 && edge.x_px < 69.5 && edge.y_px >= -0.5 && edge.y_px < 49.5)
            least = std::min(least, distance_to(edge));
        }
        const std::uint32_t word = input.nearest[map.first_pixel + i];
        if (word == CANDIDATE_MAP_EMPTY) {
          EXPECT_GT(least, 254.5 / 16 - rounding);
          ++beyond;
          continue;
        }
        ++within;
        ASSERT_LT(word & 0xffffu, map.edge_count);
        EXPECT_NEAR(std::sqrt(double(word >> 16)) / 16, least, rounding);
        EXPECT_NEAR(distance_to(input.edges[map.first_edge + (word & 0xffffu)]), least,
                    2 * rounding);
      }
  }
  EXPECT_GT(within, 5000u);
  EXPECT_GT(beyond, 1000u);
}

class CandidateMapPaths : public test::PathTest {};

TEST_P(CandidateMapPaths, EqualsTheReference) {
  std::mt19937 rng = test::test_rng();
  for (const test::ChamferInputSize& size :
       std::vector<test::ChamferInputSize>{{1, 1, 2, 3, 0, 0, 1},
                                           {7, 90, 5, 20, 0, 0, 1},
                                           {120, 80, 40, 90, 0, 0, 1},
                                           {60, 60, 3, 700, 0, 0, 1},
                                           {9, 9, 0, 0, 0, 0, 1}}) {
    SCOPED_TRACE(std::to_string(size.width) + "x" + std::to_string(size.height));
    const test::ChamferInput input = test::random_chamfer_input(rng, size);
    std::vector<std::uint32_t> found(input.nearest.size(), 1);
    tested->candidate_map(input.edges, input.maps, size.width, size.height, found);
    EXPECT_EQ(found, input.nearest);
  }
}

// More windows than a device takes workgroups along one dimension, and places no integer holds.
TEST_P(CandidateMapPaths, ManyMapsAndEdgesFarAway) {
  const std::vector<MapEdge> edges{
      {3, 3, 1}, {1e30f, 3, 1}, {3, -1e30f, 1}, {NAN, 3, 1}, {5.25f, 2.5f, 1}};
  std::vector<CandidateMap> maps;
  for (std::uint32_t m = 0; m < 70001; ++m)
    maps.push_back({{int(m % 7), int(m % 5), 3, 2}, 6 * m, m % 2, 3 + m % 3});
  for (CandidateMap& map : maps) map.edge_count = std::min(map.edge_count, 5 - map.first_edge);
  std::vector<std::uint32_t> found(6 * maps.size(), 1), expected(found.size(), 2);
  tested->candidate_map(edges, maps, 12, 12, found);
  reference->candidate_map(edges, maps, 12, 12, expected);
  EXPECT_EQ(found, expected);
}

TEST_P(CandidateMapPaths, BrokenMapsAreOurBugs) {
  const std::vector<MapEdge> edges(3);
  std::vector<std::uint32_t> nearest(12);
  const auto draw = [&](const CandidateMap& map, int width) {
    tested->candidate_map(edges, {&map, 1}, width, 8, nearest);
  };
  EXPECT_NO_THROW(draw({{0, 0, 4, 3}, 0, 0, 3}, 8));
  EXPECT_THROW(draw({{0, 0, 4, 3}, 1, 0, 3}, 8), LogicError);        // pixels beyond the list
  EXPECT_THROW(draw({{0, 0, 4, 3}, 0, 1, 3}, 8), LogicError);        // edge points beyond the list
  EXPECT_THROW(draw({{1 << 30, 0, 4, 3}, 0, 0, 3}, 8), LogicError);  // a window nowhere near
  EXPECT_THROW(draw({{0, 0, 4, 3}, 0, 0, 3}, 0), LogicError);        // no image
}

INSTANTIATE_TEST_SUITE_P(Paths, CandidateMapPaths, test::all_paths, test::param_name);

}  // namespace
}  // namespace edgescout
