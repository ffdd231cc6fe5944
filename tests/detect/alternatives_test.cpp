#include "host/detect/alternatives.h"

#include <gtest/gtest.h>

#include <numbers>

#include "host/register/pose_classifier.h"
#include "host/render/parts.h"

namespace edgescout::test {
namespace {

constexpr double PI = std::numbers::pi;
const Se3 detected{so3_exp({0.3, 0.2, 0.1}), {0.01, 0.02, 0.5}};

// Object 1 of two; a half turn about its z axis through its centre is a symmetry if asked for.
struct OnePart {
  std::vector<TemplateSet> sets{2};
  std::vector<PoseEstimate> competing;
  std::vector<Detection> detections{1};

  explicit OnePart(bool is_symmetric = false) {
    const Object part = make_part("l_bracket");
    sets[1].model.mesh = part.mesh;
    sets[1].model.center_m = 0.5 * (part.mesh.box_min_m + part.mesh.box_max_m);
    if (is_symmetric) sets[1].symmetries.discrete = {Se3{}, about_center({0, 0, PI})};
    detections[0].object = 1;
    detections[0].world_from_object = detected;
    detections[0].probability = 0.4;
    add(detected, 0.4);
  }
  // A turn of the part, and then a shift along its x axis.
  Se3 about_center(const Eigen::Vector3d& turn_rad, double x_m = 0) const {
    const Eigen::Vector3d center_m = sets[1].model.center_m;
    return {so3_exp(turn_rad),
            center_m - so3_exp(turn_rad) * center_m + Eigen::Vector3d(x_m, 0, 0)};
  }
  double diameter_m() const { return sets[1].model.mesh.diameter_m; }
  // Without an image the log-odds are minus the mean tensor value.
  void add(const Se3& pose, double probability, int object = 1) {
    PoseEstimate estimate;
    estimate.object = object;
    estimate.world_from_object = pose;
    PoseFeatures features;
    features.points = features.visible = 100;
    features.in_image = 1;
    features.mean_px = -std::log(probability / (1 - probability));
    estimate.features = {features};
    classify(estimate);
    ASSERT_NEAR(estimate.classification.probability, probability, 1e-9);
    competing.push_back(estimate);
  }
  const std::vector<AlternativePose>& alternatives() {
    set_alternatives(detections, competing, sets);
    return detections[0].alternatives;
  }
};

TEST(Alternatives, AreOtherPosesAtThePlaceMostProbableFirst) {
  OnePart t;
  const Se3 flipped = detected * t.about_center({0, 0, PI}),
            quarter = detected * t.about_center({0, PI / 2, 0});
  t.add(quarter, 0.15);
  t.add(flipped, 0.3);
  const std::vector<AlternativePose>& found = t.alternatives();
  ASSERT_EQ(found.size(), 2u);
  EXPECT_NEAR(found[0].probability, 0.3, 1e-9);
  EXPECT_EQ(found[0].world_from_object.translation_m, flipped.translation_m);
  EXPECT_NEAR(found[1].probability, 0.15, 1e-9);
  EXPECT_EQ(found[1].world_from_object.translation_m, quarter.translation_m);
  EXPECT_EQ(t.alternatives().size(), 2u) << "set anew";
}

TEST(Alternatives, AreNoneWhereNothingIsInDoubt) {
  const auto alone = [](const Eigen::Vector3d& turn_rad, double x_share, double probability,
                        int object = 1, bool is_symmetric = false) {
    OnePart t(is_symmetric);
    t.add(detected * t.about_center(turn_rad, x_share * t.diameter_m()), probability, object);
    return t.alternatives().empty();
  };
  ASSERT_FALSE(alone({0, 0, PI}, 0.2, 0.11));
  EXPECT_TRUE(alone({0, 0, PI}, 0.3, 0.11)) << "another place";
  EXPECT_TRUE(alone({0, 0, PI}, 0.2, 0.09)) << "hardly probable";
  EXPECT_TRUE(alone({0, 0, PI}, 0.2, 0.11, 0)) << "another object";
  EXPECT_TRUE(alone({0, 0, PI}, 0, 0.3, 1, true)) << "a symmetry";
  EXPECT_TRUE(alone({0.1, 0, 0}, 0, 0.3)) << "nearly the same pose";
}

TEST(Alternatives, ShareTheOddsWithTheDetection) {
  OnePart t;
  share_odds(t.detections[0]);
  EXPECT_EQ(t.detections[0].probability, 0.4) << "none";
  for (const double other : {0.4, 0.1}) {
    Detection& detection = t.detections[0];
    detection.probability = 0.4;
    detection.alternatives = {{detected, other}};
    share_odds(detection);
    const double odds = 0.4 / 0.6, others = other / (1 - other), sum = odds + others;
    EXPECT_NEAR(detection.probability, odds * odds / (sum + odds * odds), 1e-12);
    EXPECT_NEAR(detection.alternatives[0].probability, others * others / (sum + others * others),
                1e-12);
  }
  t.detections[0].probability = 1;
  t.detections[0].alternatives = {{detected, 1}, {detected, 0}};
  share_odds(t.detections[0]);
  EXPECT_GT(t.detections[0].probability, 0.999999);
  EXPECT_EQ(t.detections[0].alternatives[1].probability, 0);
}

TEST(Alternatives, OfNearlyTheSamePoseOneIsListed) {
  OnePart t;
  for (const double off_rad : {0.0, 0.05, -0.05})
    t.add(detected * t.about_center({0, 0, PI + off_rad}), 0.3 - std::abs(off_rad));
  ASSERT_EQ(t.alternatives().size(), 1u);
  EXPECT_NEAR(t.alternatives()[0].probability, 0.3, 1e-9);
}

}  // namespace
}  // namespace edgescout::test
