// Edge support by templates' points, of true poses against others and against the exact features.
#include "host/detect/template_support.h"

#include <gtest/gtest.h>

#include "host/register/pose_classifier.h"
#include "host/register/pose_features.h"
#include "tests/detect/rendered_part.h"
#include "tests/test_random.h"

namespace edgescout::test {
namespace {

struct SupportedPoses {
  std::unique_ptr<Backend> backend = make_cpu_backend(2);
  RenderedPart part{"l_bracket", 2};
  std::vector<ObjectView> views;
  std::vector<PoseEstimate> poses;  // in the world; the first is true

  SupportedPoses() {
    for (std::size_t v = 0; v < 2; ++v) views.push_back(part.with_tensors(v, *backend));
    Random random = test_random();
    add(part.world_truth());
    for (int i = 0; i < 40; ++i) {
      Se3 other = part.world_truth();
      other.translation_m += 0.02 * random.direction();
      add(other);
      other.rotation = random.rotation();
      add(other);
    }
  }
  void add(const Se3& world_from_object) {
    poses.emplace_back().world_from_object = world_from_object;
  }
  Scene scene(std::size_t first, std::size_t count) const {
    return {{&part.sets[0].model, 1}, std::span(views).subspan(first, count), *backend};
  }
  std::vector<PoseFeatures> support(std::size_t first, std::size_t count) const {
    return template_support(part.sets[0], scene(first, count), poses);
  }
};

TEST(TemplateSupport, RanksTheTruePoseAboveOthers) {
  const SupportedPoses t;
  for (const auto& [first, count] : {std::pair{0, 1}, {1, 1}, {0, 2}}) {
    const std::vector<PoseFeatures> features = t.support(std::size_t(first), std::size_t(count));
    ASSERT_EQ(features.size(), t.poses.size());
    for (std::size_t p = 1; p < features.size(); ++p)
      EXPECT_GT(PoseClassifier::rank(features[0]), PoseClassifier::rank(features[p])) << p;
  }
}

// Templates stand beside the pose and mark no silhouettes.
TEST(TemplateSupport, IsNearThatOfThePointsThatShow) {
  const SupportedPoses t;
  const PoseFeatures looked_up = t.support(0, 1)[0];
  const ObjectPose truth = t.poses[0];
  const PoseFeatures exact = features_by_view(t.scene(0, 1), {&truth, 1})(0, 0);
  EXPECT_NEAR(looked_up.support.support, exact.support.support, 0.15);
  EXPECT_GT(looked_up.support.log_ratio, 0.3 * exact.support.log_ratio);
  EXPECT_LT(looked_up.support.log_ratio, 1.5 * exact.support.log_ratio);
  EXPECT_EQ(looked_up.support.interior_log_ratio, looked_up.support.log_ratio);
}

TEST(TemplateSupport, AddsUpOverViews) {
  const SupportedPoses t;
  const std::vector<PoseFeatures> first = t.support(0, 1), second = t.support(1, 1),
                                  both = t.support(0, 2);
  for (std::size_t p = 0; p < both.size(); ++p) {
    EXPECT_NEAR(both[p].support.log_ratio, first[p].support.log_ratio + second[p].support.log_ratio,
                1e-9);
    EXPECT_EQ(both[p].points, first[p].points + second[p].points);
  }
}

}  // namespace
}  // namespace edgescout::test
