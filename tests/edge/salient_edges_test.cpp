#include "host/edge/salient_edges.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <tuple>

#include "tests/test_random.h"

namespace edgescout::test {
namespace {

constexpr int width = 100, height = 70;

std::vector<EdgePoint> random_edges(Random& random, int count) {
  std::vector<EdgePoint> edges;
  for (int i = 0; i < count; ++i)
    edges.push_back({float(random.uniform(0, width - 1)), float(random.uniform(0, height - 1)),
                     float(random.uniform(0, 3.14)), float(random.uniform(1, 100))});
  return edges;
}

std::pair<int, int> block_of(const EdgePoint& edge, int block_px) {
  return {int(edge.x_px) / block_px, int(edge.y_px) / block_px};
}

auto fields(const EdgePoint& e) { return std::tuple(e.x_px, e.y_px, e.theta_rad, e.strength); }

TEST(SalientEdges, AreTheStrongestOfEveryBlock) {
  Random random = test_random();
  const SalientOptions options{0, 0.05, 32};
  const std::vector<EdgePoint> edges = random_edges(random, 2000),
                               salient = salient_edges(edges, width, height, options);
  std::map<std::pair<int, int>, std::vector<float>> all, kept;
  for (const EdgePoint& edge : edges) all[block_of(edge, 32)].push_back(edge.strength);
  for (const EdgePoint& edge : salient) kept[block_of(edge, 32)].push_back(edge.strength);
  for (auto& [block, strengths] : all) {
    const int w = std::min(32, width - 32 * block.first),
              h = std::min(32, height - 32 * block.second);
    std::ranges::sort(strengths, std::greater());
    strengths.resize(std::min(strengths.size(), std::size_t(0.05 * w * h)));
    std::ranges::sort(kept[block], std::greater());
    EXPECT_EQ(kept[block], strengths) << block.first << ' ' << block.second;
  }
}

TEST(SalientEdges, LeaveOutTheFaintWhateverTheExposure) {
  Random random = test_random();
  std::vector<EdgePoint> edges = random_edges(random, 200);
  for (EdgePoint& edge : edges) edge.strength = random.uniform() < 0.5 ? 2 : 40;
  for (const float exposure : {1.0f, 0.1f}) {
    std::vector<EdgePoint> exposed = edges;
    for (EdgePoint& edge : exposed) edge.strength *= exposure;
    const std::vector<EdgePoint> salient = salient_edges(exposed, width, height, {0.1, 1, 48});
    const auto strong = std::ranges::count_if(
        exposed, [&](const EdgePoint& e) { return e.strength > 3 * exposure; });
    EXPECT_EQ(std::ptrdiff_t(salient.size()), strong);
    for (const EdgePoint& edge : salient) EXPECT_FLOAT_EQ(edge.strength, 40 * exposure);
  }
}

TEST(SalientEdges, DoNotDependOnTheOrderOfTheEdges) {
  Random random = test_random();
  std::vector<EdgePoint> edges = random_edges(random, 1000);
  for (EdgePoint& edge : edges) edge.strength = float(random.below(5));  // ties
  const auto sorted = [&] {
    std::vector<EdgePoint> salient = salient_edges(edges, width, height, {0.1, 0.05, 48});
    std::ranges::sort(salient, {}, fields);
    return salient;
  };
  const std::vector<EdgePoint> before = sorted();
  std::ranges::reverse(edges);
  const std::vector<EdgePoint> after = sorted();
  ASSERT_EQ(before.size(), after.size());
  for (std::size_t i = 0; i < before.size(); ++i) EXPECT_EQ(fields(before[i]), fields(after[i]));
}

TEST(SalientEdges, OfNothingAreNone) { EXPECT_TRUE(salient_edges({}, width, height).empty()); }

}  // namespace
}  // namespace edgescout::test
