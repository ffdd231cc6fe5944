#include "host/detect/probability.h"

#include <gtest/gtest.h>

#include "tests/test_random.h"

namespace edgescout::test {
namespace {

PoseFeatures random_features(Random& random) {
  PoseFeatures f;
  f.psi = random.uniform();
  f.mean_px = random.uniform(0, 60);
  f.matched = random.uniform();
  f.points = random.uniform(0, 300);
  f.length_px = random.uniform(0, 1000);
  f.in_image = random.uniform();
  f.shading = {1000, 1e6, random.uniform(0, 1e6)};
  return f;
}

TEST(PoseProbability, IsOneAndGrowsWithWhatSpeaksForThePose) {
  Random random = test_random();
  for (int i = 0; i < 1000; ++i) {
    const PoseFeatures f = random_features(random);
    const double p = pose_probability(f);
    EXPECT_TRUE(p >= 0 && p <= 1) << p;
    const auto expect_grows = [&](double PoseFeatures::*feature, double to) {
      PoseFeatures better = f;
      better.*feature = to;
      EXPECT_GE(pose_probability(better), p);
    };
    expect_grows(&PoseFeatures::psi, random.uniform(f.psi, 1));
    expect_grows(&PoseFeatures::length_px, random.uniform(f.length_px, 1000));
    if (p == 0) continue;  // too few points for anything else to tell
    PoseFeatures better = f;
    better.mean_px = random.uniform(0, f.mean_px);
    EXPECT_GT(pose_probability(better), p);
    better = f;
    better.in_image = random.uniform(f.in_image, 1);
    EXPECT_GT(pose_probability(better), p);
    better = f;
    better.shading.unexplained = random.uniform(0, f.shading.unexplained);
    EXPECT_GT(pose_probability(better), p);
  }
}

TEST(PoseProbability, TellsTheBestFromTheWorst) {
  PoseFeatures f{.psi = 1,
                 .matched = 1,
                 .points = 200,
                 .length_px = 500,
                 .in_image = 1,
                 .visible = 200,
                 .shading = {1000, 1e6, 1e4}};
  EXPECT_GT(pose_probability(f), 0.9);
  f.psi = 0.65;
  f.matched = 0.2;
  f.mean_px = 20;
  EXPECT_LT(pose_probability(f), 0.1);
  EXPECT_EQ(pose_probability(PoseFeatures{}), 0);
}

}  // namespace
}  // namespace edgescout::test
