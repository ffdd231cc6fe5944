// Features of several views are those of each view, weighted by its visible points.
#include "host/register/pose_features.h"

#include <gtest/gtest.h>

#include "host/register/pose_classifier.h"
#include "tests/register/scene.h"
#include "tests/test_random.h"

namespace edgescout::test {
namespace {

TEST(PoseFeatures, OfAllViewsAreTheMeansOverTheirPoints) {
  Random random = test_random();
  const auto backend = make_reference_backend();
  const PartScene scene("l_bracket", 3, random, *backend);
  const std::vector<ObjectPose> poses{
      {0, scene.truth}, scene.start, {0, {Eigen::Quaterniond::Identity(), {50, 0, 0}}}};
  const std::vector<EdgeModel> models{scene.model};
  const FeatureOptions options{{}, {}};
  const std::vector<PoseFeatures> all = pooled_features(scene.on(*backend), poses, options);
  const Grid<PoseFeatures> by_view = features_by_view(scene.on(*backend), poses, options);
  ASSERT_EQ(by_view.rows(), 3u);
  ASSERT_EQ(by_view.columns(), 3u);
  for (std::size_t p = 0; p < 2; ++p) {
    double points = 0, mean = 0, matched = 0, visible = 0, length = 0;
    for (std::size_t v = 0; v < 3; ++v) {
      const Scene one{models, std::span(scene.views).subspan(v, 1), *backend};
      const PoseFeatures alone = pooled_features(one, poses, options)[p], &f = by_view(p, v);
      EXPECT_EQ(f.points, alone.points);
      EXPECT_DOUBLE_EQ(f.mean_px, alone.mean_px);
      points += f.points, mean += f.points * f.mean_px, matched += f.points * f.matched,
          visible += f.visible, length += f.length_px;
    }
    EXPECT_GT(points, 100);
    EXPECT_DOUBLE_EQ(all[p].points, points);
    EXPECT_NEAR(all[p].mean_px, mean / points, 1e-9);
    EXPECT_NEAR(all[p].matched, matched / points, 1e-9);
    EXPECT_NEAR(all[p].in_image, points / visible, 1e-12);
    EXPECT_NEAR(all[p].length_px, length, 1e-9);
  }
  EXPECT_EQ(all[2].points, 0);
  EXPECT_EQ(all[2].mean_px, options.score.cap_px);
}

TEST(PoseFeatures, AreClassifiedWhenTheyAreMeasured) {
  Random random = test_random();
  const auto backend = make_cpu_backend(2);
  const PartScene scene("l_bracket", 2, random, *backend);
  std::vector<PoseEstimate> poses(1);
  poses[0].world_from_object = scene.truth;
  measure_features(scene.on(*backend), poses);
  ASSERT_EQ(poses[0].features.size(), 2u);
  EXPECT_GT(poses[0].classification.pooled.points, 100);
  EXPECT_EQ(poses[0].classification.rank, PoseClassifier::rank(poses[0].features));
  EXPECT_EQ(poses[0].classification.probability, PoseClassifier::probability(poses[0].features));
}

// An image cut in two: each half has its own part of the points and of the length.
TEST(PoseFeatures, CountWhatLiesInTheImage) {
  Random random = test_random();
  const auto backend = make_cpu_backend(2);
  const PartScene scene("bearing_block", 1, random, *backend);
  const std::vector<EdgeModel> models{scene.model};
  const ObjectPose truth{0, scene.truth};
  const Camera camera = scene.views[0].camera;
  const auto features_in = [&](int x0, int width) {
    Camera cut = camera;
    cut.width = width;
    cut.cx -= x0;
    ObjectView view = scene.views[0];
    view.camera = cut;
    view.tensor = backend->make_view({}, cut.width, cut.height, {}, intrinsics_of(cut), {});
    return pooled_features({models, {&view, 1}, *backend}, {&truth, 1}, {{}, {}})[0];
  };
  const int middle = camera.width / 2;
  const PoseFeatures whole = features_in(0, camera.width), left = features_in(0, middle),
                     right = features_in(middle, camera.width - middle);
  EXPECT_GT(left.length_px, 0.1 * whole.length_px);
  EXPECT_GT(right.length_px, 0.1 * whole.length_px);
  EXPECT_EQ(left.points + right.points, whole.points);
  EXPECT_NEAR(left.length_px + right.length_px, whole.length_px, 1e-3 * whole.length_px);
  EXPECT_NEAR(left.in_image + right.in_image, 1, 1e-9);
}

}  // namespace
}  // namespace edgescout::test
