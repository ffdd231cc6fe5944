// Which model points keep an edge point that several have taken.
#include "host/register/contested_edges.h"

#include <gtest/gtest.h>

#include <vector>

namespace edgescout {
namespace {

// Two horizontal edges, 4 px apart, a point at every pixel.
std::vector<EdgePoint> two_edges() {
  std::vector<EdgePoint> edges;
  for (int x = 0; x < 40; ++x)
    for (const float y : {10.0f, 14.0f}) edges.push_back({float(x), y, 0, 20});
  return edges;
}

struct OfTwoEdges {
  EdgeIndex index{two_edges(), 40, 24};
  ContestedEdges contested{index};
  const EdgePoint& at(float x, float y) const { return *index.nearest({x, y}, {1, 0}, {1, 1}); }
};

TEST(ContestedEdges, GoToTheNearestLine) {
  OfTwoEdges edges;
  edges.contested.take(edges.at(20, 10), 1.4);
  EXPECT_FALSE(edges.contested.is_lost(edges.at(20, 10), 1.4)) << "nobody else took it";
  edges.contested.take(edges.at(21, 10), 0.2);
  EXPECT_TRUE(edges.contested.is_lost(edges.at(20, 10), 1.4));
  EXPECT_FALSE(edges.contested.is_lost(edges.at(21, 10), 0.2));
}

TEST(ContestedEdges, StayWithAllPointsOfOneLine) {
  OfTwoEdges edges;
  for (int x = 10; x < 20; ++x) edges.contested.take(edges.at(float(x), 10), 0.5 + 0.02 * x);
  for (int x = 10; x < 20; ++x)
    EXPECT_FALSE(edges.contested.is_lost(edges.at(float(x), 10), 0.5 + 0.02 * x)) << x;
}

TEST(ContestedEdges, AreOtherEdgesAndOtherStretches) {
  OfTwoEdges edges;
  edges.contested.take(edges.at(20, 10), 0.1);
  edges.contested.take(edges.at(20, 14), 1.5);
  EXPECT_FALSE(edges.contested.is_lost(edges.at(20, 14), 1.5)) << "4 px away";
  edges.contested.take(edges.at(23, 10), 1.5);
  EXPECT_FALSE(edges.contested.is_lost(edges.at(23, 10), 1.5)) << "3 px along the edge";
}

TEST(ContestedEdges, AreForgottenWhenCleared) {
  OfTwoEdges edges;
  edges.contested.take(edges.at(20, 10), 0.1);
  edges.contested.clear();
  edges.contested.take(edges.at(20, 10), 1.4);
  EXPECT_FALSE(edges.contested.is_lost(edges.at(20, 10), 1.4));
}

}  // namespace
}  // namespace edgescout
