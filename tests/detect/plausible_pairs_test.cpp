// The penetration of boxes is known; that of parts is tested by pushing them apart along a fine set
// of directions.
#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <numeric>

#include "host/detect/plausible_pairs.h"
#include "host/model/viewpoints.h"
#include "host/render/parts.h"
#include "kernels/thread_pool.h"
#include "tests/io/expect_input_error.h"
#include "tests/model/box.h"
#include "tests/test_random.h"

namespace edgescout::test {
namespace {

bool are_plausible(const std::vector<EdgeModel>& models, const ObjectPose& a, const ObjectPose& b,
                   double penetration_m) {
  ThreadPool pool(1);
  const BitMatrix pairs =
      plausible_pairs(models, std::vector<ObjectPose>{a, b}, penetration_m, pool);
  EXPECT_TRUE(pairs.has(0, 0) && pairs.has(1, 1));
  EXPECT_EQ(pairs.has(0, 1), pairs.has(1, 0));
  return pairs.has(0, 1);
}

ObjectPose at(int object, double x_m, double y_m, double z_m) {
  return {object, {Eigen::Quaterniond::Identity(), {x_m, y_m, z_m}}};
}

// Boxes of 40 x 60 x 80 mm that overlap by d along an axis, both turned and shifted as one.
TEST(PlausiblePairs, BoxesMayOverlapByTheTolerance) {
  Random random = test_random();
  const std::vector<EdgeModel> models{make_edge_model(box_mesh(0.04, 0.06, 0.08))};
  const double sides[] = {0.04, 0.06, 0.08};
  for (int i = 0; i < 60; ++i) {
    const int axis = random.below(3);
    const double overlap = random.uniform(0.0005, 0.008),
                 tolerance = overlap * (i % 2 ? 1.03 : 0.97);
    Eigen::Vector3d shift(0.011 * random.uniform(), 0.009 * random.uniform(),
                          0.01 * random.uniform());
    shift[axis] = sides[axis] - overlap;
    const Se3 world{random.rotation(), random.direction()};
    const ObjectPose a{0, world}, b{0, world * Se3{Eigen::Quaterniond::Identity(), shift}};
    EXPECT_EQ(are_plausible(models, a, b, tolerance), i % 2 == 1)
        << "overlap " << overlap << " along axis " << axis;
  }
}

TEST(PlausiblePairs, AnEdgeReachesAsDeepAsItsTip) {
  // The edge of a box turned by 45 degrees dips by d into the top of another.
  const std::vector<EdgeModel> models{make_edge_model(box_mesh(0.05, 0.05, 0.05))};
  const double half_diagonal = 0.025 * std::sqrt(2.0);
  for (double d : {0.001, 0.003, 0.006}) {
    ObjectPose tip = at(0, 0.001, 0.002, 0.025 + half_diagonal - d);
    tip.world_from_object.rotation = so3_exp({0, std::numbers::pi / 4, 0});
    EXPECT_TRUE(are_plausible(models, at(0, 0, 0, 0), tip, 1.03 * d));
    EXPECT_FALSE(are_plausible(models, at(0, 0, 0, 0), tip, 0.97 * d));
  }
}

TEST(PlausiblePairs, TouchingAndApartAreFine) {
  const std::vector<EdgeModel> models{make_edge_model(box_mesh(0.05, 0.05, 0.05))};
  EXPECT_TRUE(are_plausible(models, at(0, 0, 0, 0), at(0, 0.05, 0.01, 0), 0.0005));
  EXPECT_TRUE(are_plausible(models, at(0, 0, 0, 0), at(0, 0.0501, 0.01, 0), 0));
  EXPECT_FALSE(are_plausible(models, at(0, 0, 0, 0), at(0, 0.0499, 0.01, 0), 0));
}

TEST(PlausiblePairs, OneInsideTheOtherClashes) {
  const std::vector<EdgeModel> models{make_edge_model(box_mesh(0.1, 0.1, 0.1)),
                                      make_edge_model(box_mesh(0.02, 0.02, 0.02))};
  for (const bool swapped : {false, true}) {
    const ObjectPose outer = at(0, 0, 0, 0), inner = at(1, 0.01, -0.02, 0.005);
    EXPECT_FALSE(are_plausible(models, swapped ? inner : outer, swapped ? outer : inner, 0.002));
    EXPECT_FALSE(are_plausible(models, swapped ? inner : outer, swapped ? outer : inner, 0));
  }
  // 20 mm deep below the nearest face, its far side 31 mm: a push of that length takes it out.
  const ObjectPose inner = at(1, 0, 0, 0.05 - 0.021);
  EXPECT_FALSE(are_plausible(models, at(0, 0, 0, 0), inner, 0.030));
  EXPECT_TRUE(are_plausible(models, at(0, 0, 0, 0), inner, 0.034));
}

// A nut around a shaft: their bounding boxes overlap, the parts do not.
TEST(PlausiblePairs, HolesAreEmpty) {
  const std::vector<EdgeModel> models{make_edge_model(make_ring(0.03, 0.02, 0.01)),
                                      make_edge_model(make_bar(0.019, 0.1))};
  EXPECT_TRUE(are_plausible(models, at(0, 0, 0, 0), at(1, 0, 0, 0), 0));
  EXPECT_FALSE(are_plausible(models, at(0, 0, 0, 0), at(1, 0.005, 0, 0), 0));
  EXPECT_FALSE(
      are_plausible(models, at(0, 0, 0, 0), at(1, 0.008, 0, 0), 0.002));  // 7 mm into the wall
  EXPECT_TRUE(are_plausible(models, at(0, 0, 0, 0), at(1, 0.0025, 0, 0),
                            0.002));  // 1.5 mm; the other side is only 2.5 mm away
}

// A pair that is not plausible clashes wherever it is pushed; one that is plausible comes apart, by
// the answer at zero tolerance.
TEST(PlausiblePairs, PartsAgreeWithPushingThemEverywhere) {
  Random random = test_random();
  const std::vector<EdgeModel> models{make_edge_model(make_part("l_bracket").mesh),
                                      make_edge_model(make_part("bearing_block").mesh)};
  const double tolerance = 0.002;
  int clashing = 0, pushed_apart = 0;
  for (int i = 0; i < 25; ++i) {
    const ObjectPose a{i % 2, {random.rotation(), Eigen::Vector3d::Zero()}};
    ObjectPose b{1 - i % 2, {random.rotation(), random.uniform(0.02, 0.05) * random.direction()}};
    const bool free = are_plausible(models, a, b, 0),
               tolerated = are_plausible(models, a, b, tolerance);
    EXPECT_TRUE(!free || tolerated);
    // A tenth less than the tolerance, in 92 directions.
    bool comes_apart = free;
    for (const Eigen::Vector3d& d : icosphere(3)) {
      if (comes_apart) break;
      const ObjectPose moved{
          b.object,
          {b.world_from_object.rotation, b.world_from_object.translation_m + 0.9 * tolerance * d}};
      comes_apart = are_plausible(models, a, moved, 0);
    }
    EXPECT_TRUE(tolerated || !comes_apart);
    clashing += !tolerated;
    pushed_apart += tolerated && !free;
  }
  std::printf("%d of 25 clash, %d within the tolerance\n", clashing, pushed_apart);
  EXPECT_GE(clashing, 5);
  EXPECT_LE(clashing, 20);
}

TEST(PlausiblePairs, ManyCandidatesOnSeveralThreads) {
  Random random = test_random();
  const std::vector<EdgeModel> models{make_edge_model(make_part("l_bracket").mesh),
                                      make_edge_model(make_part("hex_nut").mesh),
                                      make_edge_model(make_part("bearing_block").mesh)};
  std::vector<ObjectPose> candidates;
  for (int i = 0; i < 40; ++i)
    candidates.push_back(
        {i % 3,
         {random.rotation(),
          {random.uniform(0, 0.15), random.uniform(0, 0.15), random.uniform(0, 0.05)}}});
  ThreadPool one(1), two(2);
  const auto start = std::chrono::steady_clock::now();
  const BitMatrix pairs = plausible_pairs(models, candidates, 0.002, two);
  const double seconds =
      std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  EXPECT_EQ(pairs.words, plausible_pairs(models, candidates, 0.002, one).words);
  int clashes = 0;
  for (std::size_t i = 0; i < 40; ++i)
    for (std::size_t j = 0; j < i; ++j) {
      clashes += !pairs.has(i, j);
      if ((i * 40 + j) % 7 == 0) {
        EXPECT_EQ(pairs.has(i, j), are_plausible(models, candidates[i], candidates[j], 0.002))
            << i << " " << j;
      }
    }
  std::printf("40 candidates: %d of 780 pairs clash, %.1f ms\n", clashes, 1000 * seconds);
  EXPECT_GT(clashes, 10);
  EXPECT_LT(clashes, 700);
}

TEST(PlausiblePairs, RefusesANegativeTolerance) {
  ThreadPool pool(1);
  expect_input_error([&] { plausible_pairs({}, {}, -1, pool); }, {"penetration"});
  EXPECT_EQ(plausible_pairs({}, {}, 0, pool).rows, 0u);
}

TEST(ExclusiveProbabilities, CountMoreProbablePosesInTheSamePlace) {
  BitMatrix plausible(4, 4);
  const auto allow = [&](std::size_t i, std::size_t j) {
    plausible.set(i, j), plausible.set(j, i);
  };
  for (std::size_t i = 0; i < 4; ++i) allow(i, i);
  allow(0, 1), allow(0, 3), allow(1, 3), allow(2, 3);  // 2 would stand in 0 and in 1
  const std::vector<double> left =
      exclusive_probabilities(std::vector{0.9, 0.3, 0.8, 0.4}, plausible);
  EXPECT_DOUBLE_EQ(left[0], 0.9);
  EXPECT_DOUBLE_EQ(left[2], 0.8 * (1 - 0.9));
  // a pose that is nearly ruled out itself rules out little
  EXPECT_DOUBLE_EQ(left[1], 0.3 * (1 - left[2]));
  EXPECT_DOUBLE_EQ(left[3], 0.4);
  EXPECT_TRUE(exclusive_probabilities({}, BitMatrix(0, 0)).empty());
}

TEST(ExclusiveProbabilities, OfPosesInOnePlaceSumToOneAtMost) {
  Random random = test_random();
  for (const std::size_t count : {2, 3, 5, 10}) {
    BitMatrix none(count, count);
    for (std::size_t i = 0; i < count; ++i) none.set(i, i);
    std::vector<double> p;
    for (std::size_t i = 0; i < count; ++i) p.push_back(random.uniform(0.4, 1));
    const std::vector<double> left = exclusive_probabilities(p, none);
    EXPECT_LE(std::accumulate(left.begin(), left.end(), 0.0), 1 + 1e-12) << count;
    EXPECT_EQ(*std::ranges::max_element(left), *std::ranges::max_element(p));
    for (const double x : left) EXPECT_GE(x, 0);
  }
}

// Two poses that do not collide may each collide with a third one.
TEST(ExclusiveProbabilities, OfIndependentOnesMultiply) {
  BitMatrix plausible(3, 3);
  for (std::size_t i = 0; i < 3; ++i) plausible.set(i, i);
  plausible.set(0, 1), plausible.set(1, 0);
  const std::vector<double> left = exclusive_probabilities(std::vector{0.6, 0.5, 0.4}, plausible);
  EXPECT_DOUBLE_EQ(left[2], 0.4 * (1 - 0.6) * (1 - 0.5));
}

}  // namespace
}  // namespace edgescout::test
