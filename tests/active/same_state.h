// Compares two active detections.
#pragma once

#include <gtest/gtest.h>

#include <bit>

#include "host/active/scout_state.h"

namespace edgescout::test {

inline bool same(const Se3& a, const Se3& b) {
  return a.translation_m == b.translation_m && a.rotation.coeffs() == b.rotation.coeffs();
}

// Everything but the times.
inline void expect_same(const ScoutState& a, const ScoutState& b) {
  ASSERT_EQ(a.steps.size(), b.steps.size());
  for (std::size_t i = 0; i < a.steps.size(); ++i) {
    EXPECT_EQ(a.steps[i].decision.view, b.steps[i].decision.view) << i;
    ASSERT_EQ(a.steps[i].decision.views.size(), b.steps[i].decision.views.size());
    for (std::size_t v = 0; v < a.steps[i].decision.views.size(); ++v)
      EXPECT_EQ(a.steps[i].decision.views[v].information, b.steps[i].decision.views[v].information);
    EXPECT_EQ(a.steps[i].image.pixels, b.steps[i].image.pixels);
    EXPECT_EQ(a.steps[i].entropy_nats, b.steps[i].entropy_nats);
    EXPECT_EQ(a.steps[i].update.gained_nats, b.steps[i].update.gained_nats);
    ASSERT_EQ(a.steps[i].extrinsics_checks.size(), b.steps[i].extrinsics_checks.size());
    for (std::size_t v = 0; v < a.steps[i].extrinsics_checks.size(); ++v) {
      EXPECT_EQ(a.steps[i].extrinsics_checks[v].residual_px,
                b.steps[i].extrinsics_checks[v].residual_px);
      EXPECT_EQ(a.steps[i].extrinsics_checks[v].missing, b.steps[i].extrinsics_checks[v].missing);
      EXPECT_EQ(a.steps[i].extrinsics_checks[v].disagrees,
                b.steps[i].extrinsics_checks[v].disagrees);
    }
  }
  ASSERT_EQ(a.particles.size(), b.particles.size());
  for (std::size_t i = 0; i < a.particles.size(); ++i) {
    EXPECT_TRUE(same(a.particles[i].world_from_object, b.particles[i].world_from_object)) << i;
    EXPECT_EQ(a.particles[i].log_weight, b.particles[i].log_weight);
    EXPECT_EQ(a.particles[i].upsilon_px2, b.particles[i].upsilon_px2);
    EXPECT_EQ(a.particles[i].resampled_px2, b.particles[i].resampled_px2);
  }
  ASSERT_EQ(a.unseen_px2.size(), b.unseen_px2.size());
  for (std::size_t v = 0; v < a.unseen_px2.size(); ++v)  // NaN in both is the same
    EXPECT_EQ(std::bit_cast<std::uint64_t>(a.unseen_px2[v]),
              std::bit_cast<std::uint64_t>(b.unseen_px2[v]));
  ASSERT_EQ(a.detections.size(), b.detections.size());
  for (std::size_t i = 0; i < a.detections.size(); ++i) {
    EXPECT_TRUE(same(a.detections[i].detection.world_from_object,
                     b.detections[i].detection.world_from_object));
    EXPECT_EQ(a.detections[i].detection.probability, b.detections[i].detection.probability);
    EXPECT_EQ(a.detections[i].supporting_images, b.detections[i].supporting_images);
  }
  EXPECT_EQ(a.failed.size(), b.failed.size());
  EXPECT_EQ(a.end, b.end);
}

inline std::vector<int> views_of(const ScoutState& state) {
  std::vector<int> views;
  for (const ScoutStep& step : state.steps) views.push_back(step.decision.view);
  return views;
}

}  // namespace edgescout::test
