#include "host/detect/edge_claims.h"

#include <gtest/gtest.h>

#include "host/register/pose_classifier.h"
#include "host/register/visible_in_views.h"
#include "tests/detect/part_image.h"

namespace edgescout::test {
namespace {

PoseEstimate estimate_of(const Se3& world_from_object, const std::vector<PoseFeatures>& features) {
  PoseEstimate estimate;
  estimate.world_from_object = world_from_object;
  estimate.features = features;
  classify(estimate);
  return estimate;
}

// Two brackets side by side.
struct TwoParts {
  std::unique_ptr<Backend> backend = make_cpu_backend(2);
  std::vector<EdgeModel> models{part_model("l_bracket")};
  Se3 left{so3_exp({0.6, 0.3, 0.2}), {-0.06, 0, 0.35}},
      right{so3_exp({2.1, -0.4, 1.0}), {0.06, 0.01, 0.35}};
  std::vector<ObjectView> views;

  TwoParts() {
    const EdgeModel dense = part_model("l_bracket", 2e-4);
    std::vector<EdgePoint> edges = ideal_edges(dense, small_camera(), left, *backend);
    const std::vector<EdgePoint> more = ideal_edges(dense, small_camera(), right, *backend);
    edges.insert(edges.end(), more.begin(), more.end());
    views.push_back(view_of_edges(edges, small_camera(), 1, *backend));
  }
  static Se3 shifted(const Se3& pose, double x_m) {
    return {pose.rotation, pose.translation_m + Eigen::Vector3d(x_m, 0, 0)};
  }
  // Poses whose edges agree fully and have these lengths, px; a negative length: no edge agrees. An
  // image supports every px with one nat.
  std::vector<EdgeClaim> choose(const std::vector<Se3>& poses,
                                const std::vector<double>& lengths_px,
                                const EdgeClaimOptions& options = {}) const {
    std::vector<PoseEstimate> estimates;
    for (std::size_t i = 0; i < poses.size(); ++i) {
      PoseFeatures f;
      f.psi = lengths_px[i] > 0 ? 1 : 0;
      f.points = 100;
      f.in_image = 1;
      f.length_px = std::abs(lengths_px[i]);
      f.support.log_ratio = float(lengths_px[i]);
      estimates.push_back(estimate_of(poses[i], {f}));
    }
    return claim_edges({models, views, *backend}, estimates, options);
  }
};

std::vector<std::size_t> indices(const std::vector<EdgeClaim>& chosen) {
  std::vector<std::size_t> out;
  for (const EdgeClaim& c : chosen) out.push_back(c.index);
  return out;
}
using Indices = std::vector<std::size_t>;

TEST(ClaimEdges, OfTwoPosesOnTheSameEdgesTheBetterWins) {
  const TwoParts t;
  const std::vector<Se3> poses{t.left, t.shifted(t.left, 0.0005)};
  EXPECT_EQ(indices(t.choose(poses, {100, 90})), Indices{0});
  EXPECT_EQ(indices(t.choose(poses, {90, 100})), Indices{1});
}

TEST(ClaimEdges, PosesOnDifferentEdgesBothStay) {
  const TwoParts t;
  const std::vector<EdgeClaim> chosen = t.choose({t.left, t.right}, {90, 100});
  EXPECT_EQ(indices(chosen), (Indices{1, 0}));
  for (const EdgeClaim& c : chosen) EXPECT_EQ(c.unclaimed, 1);
  EXPECT_EQ(indices(t.choose({t.left, t.right, t.shifted(t.right, 0.0005)}, {90, 100, 110})),
            (Indices{2, 0}));
}

TEST(ClaimEdges, DropsPosesThatExplainNothing) {
  const TwoParts t;
  const Se3 nowhere{t.left.rotation, {0, 0.07, 0.35}};
  EXPECT_EQ(indices(t.choose({nowhere, t.left}, {1000, 10})), Indices{1});
  EXPECT_EQ(indices(t.choose({t.left, t.right}, {10, -1})), Indices{0});
  EXPECT_TRUE(t.choose({}, {}).empty());
}

TEST(ClaimEdges, ToleratesAsMuchClaimedAsTheOptionAllows) {
  const TwoParts t;
  const std::vector<Se3> poses{t.left, t.shifted(t.left, 0.0005)};
  EdgeClaimOptions all;
  all.max_claimed = 1;
  const std::vector<EdgeClaim> chosen = t.choose(poses, {100, 90}, all);
  for (const EdgeClaim& c : chosen)
    EXPECT_TRUE(c.unclaimed >= 0 && c.unclaimed <= 1) << c.unclaimed;
  ASSERT_FALSE(chosen.empty());
  EXPECT_EQ(chosen[0].index, 0u);
  EXPECT_EQ(chosen[0].unclaimed, 1);
  for (std::size_t i = 1; i < chosen.size(); ++i) EXPECT_LT(chosen[i].unclaimed, 0.1);
}

TEST(ClaimEdges, CountsOnlyViewsWithEdges) {
  TwoParts t;
  t.views[0].edges = nullptr;
  EXPECT_TRUE(t.choose({t.left}, {100}).empty());
}

TEST(ClaimEdges, SumsOverAllViews) {
  TwoParts t;
  const EdgeModel dense = part_model("l_bracket", 2e-4);
  const auto view_of_one = [&](const Se3& pose) {
    return view_of_edges(ideal_edges(dense, small_camera(), pose, *t.backend), small_camera(), 1,
                         *t.backend);
  };
  t.views = {view_of_one(t.left)};
  EXPECT_EQ(indices(t.choose({t.left, t.right}, {90, 100})), Indices{0});
  t.views.push_back(view_of_one(t.right));
  EXPECT_EQ(indices(t.choose({t.left, t.right}, {90, 100})), (Indices{1, 0}));
}

// Views in which others hide a pose do not count against it.
TEST(ClaimEdges, KeepsPosesThatSomeViewsShow) {
  const TwoParts t;
  PoseFeatures good, hidden;
  good.points = good.visible = hidden.points = hidden.visible = 200;
  good.in_image = hidden.in_image = 1;
  good.length_px = hidden.length_px = 500;
  good.psi = 0.95;
  hidden.psi = 0.2;
  good.shading = {1000, 1e6, 1e4};
  const std::vector<PoseFeatures> shown{good, good, good, hidden, hidden, hidden}, never(6, hidden),
      once{good, hidden, hidden, hidden};
  ASSERT_LT(psi_z_score(pool_over_views(shown)), 0);
  const auto claims = [&](const std::vector<PoseFeatures>& features) {
    return claim_edges({t.models, t.views, *t.backend}, std::vector{estimate_of(t.left, features)});
  };
  EXPECT_EQ(claims(shown).size(), 1u);
  for (const std::vector<PoseFeatures>& features : {never, once})
    EXPECT_TRUE(claims(features).empty());
}

TEST(ClaimedFraction, IsThatOfTheEdgesThatAPoseExplains) {
  const TwoParts t;
  const Scene scene{t.models, t.views, *t.backend};
  const auto claimed = [&](const Se3& pose, std::vector<Se3> claimants) {
    std::vector<ObjectPose> poses;
    for (const Se3& claimant : claimants) poses.push_back({0, claimant});
    return claimed_fraction(scene, {0, pose}, poses);
  };
  EXPECT_EQ(claimed(t.left, {}), 0);
  EXPECT_EQ(claimed(t.left, {t.right}), 0);
  EXPECT_EQ(claimed(t.left, {t.left}), 1);
  EXPECT_EQ(claimed(t.left, {t.right, t.shifted(t.left, 0.0005)}), 1);
  const double by_shifted = claimed(t.left, {t.shifted(t.left, 0.01)});
  EXPECT_GT(by_shifted, 0);
  EXPECT_LT(by_shifted, 0.8);
  EXPECT_EQ(claimed({t.left.rotation, {0, 0.07, 0.35}}, {t.left}), 0) << "it explains nothing";
}

}  // namespace
}  // namespace edgescout::test
