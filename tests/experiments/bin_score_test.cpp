#include "host/experiments/bin_score.h"

#include <gtest/gtest.h>

#include "host/render/parts.h"

namespace edgescout::test {
namespace {

const Camera camera{640, 480, 760, 760, 319.5, 239.5, {}};

Se3 at(double x, double y) { return {Eigen::Quaterniond::Identity(), {x, y, 0}}; }
Se3 camera_from_world() { return {Eigen::Quaterniond::Identity(), {0, 0, 0.5}}; }

ScoutStep reporting(const std::vector<std::pair<int, Se3>>& poses) {
  ScoutStep step;
  for (const auto& [object, pose] : poses) {
    ModeDetection mode;
    mode.detection.object = object;
    mode.detection.world_from_object = pose;
    step.detections.push_back(mode);
  }
  return step;
}

const std::vector<Object>& objects() {
  static const std::vector<Object> parts{make_part("l_bracket"), make_part("u_channel")};
  return parts;
}

BinScore score_of(const std::vector<BinInstance>& instances, const ScoutStep& step) {
  return score_bin(instances, step, objects(), camera, camera_from_world());
}

TEST(BinJudge, SplitsByWhatShows) {
  const std::vector<BinInstance> instances{
      {0, at(0, 0), 0.9}, {0, at(0.1, 0), 0.3}, {1, at(0, 0.1), 0.71}, {1, at(0.1, 0.1), 0.05}};
  const BinScore score =
      score_of(instances, reporting({{0, at(0, 0)}, {0, at(0.1, 0)}, {1, at(0.1, 0.1)}}));
  EXPECT_EQ(score.light.instances, 2);
  EXPECT_EQ(score.heavy.instances, 1) << "what hardly shows does not count";
  EXPECT_EQ(score.light.correct, 1);
  EXPECT_EQ(score.heavy.correct, 1);
  EXPECT_EQ(score.light.wrong + score.heavy.wrong, 0) << "and finding it is not wrong";
}

TEST(BinJudge, RightIsBelowFiveMillimetresAndATenthOfARadian) {
  const std::vector<BinInstance> instances{{0, at(0, 0), 1}};
  EXPECT_EQ(score_of(instances, reporting({{0, at(0.0049, 0)}})).light.correct, 1);
  EXPECT_EQ(score_of(instances, reporting({{0, at(0.0051, 0)}})).light.correct, 0);
  EXPECT_EQ(score_of(instances, reporting({{0, at(0.0051, 0)}})).light.wrong, 1);
  // 5.1 mm at 0.5 m are 7.8 px: right in the image.
  EXPECT_EQ(score_of(instances, reporting({{0, at(0.0051, 0)}})).light.correct_px, 1);
  const auto turned = [](double rad) {
    return Se3{Eigen::Quaterniond(Eigen::AngleAxisd(rad, Eigen::Vector3d::UnitZ())), {0, 0, 0}};
  };
  EXPECT_EQ(score_of(instances, reporting({{0, turned(0.099)}})).light.correct, 1);
  EXPECT_EQ(score_of(instances, reporting({{0, turned(0.101)}})).light.correct, 0);
}

TEST(BinJudge, AnInstanceIsFoundOnceAndByItsOwnType) {
  const std::vector<BinInstance> instances{{0, at(0, 0), 1}};
  const BinScore twice = score_of(instances, reporting({{0, at(0, 0)}, {0, at(0.001, 0)}}));
  EXPECT_EQ(twice.light.correct, 1);
  EXPECT_EQ(twice.light.wrong, 1);
  const BinScore other = score_of(instances, reporting({{1, at(0, 0)}}));
  EXPECT_EQ(other.light.correct, 0);
  EXPECT_EQ(other.light.wrong, 1);
}

TEST(BinJudge, AllAreWrongWhereThereIsNoInstance) {
  const BinScore none = score_of({}, reporting({{0, at(0, 0)}, {1, at(0.1, 0)}}));
  EXPECT_EQ(none.heavy.wrong, 2);
  EXPECT_EQ(none.heavy.wrong_px, 2);
  EXPECT_EQ(none.light.wrong + none.light.instances + none.heavy.instances, 0);
}

TEST(BinJudge, AFalseOneBelongsToItsNearestInstance) {
  const std::vector<BinInstance> instances{{0, at(0, 0), 1}, {0, at(0.2, 0), 0.4}};
  const BinScore score = score_of(instances, reporting({{0, at(0.15, 0)}}));
  EXPECT_EQ(score.light.wrong, 0);
  EXPECT_EQ(score.heavy.wrong, 1);
}

TEST(BinJudge, FollowedIsWhatAParticleHasRight) {
  const std::vector<BinInstance> instances{{0, at(0, 0), 1}, {0, at(0.2, 0), 0.4}};
  ScoutStep step;
  Particle particle;
  particle.object = 0;
  particle.world_from_object = at(0.203, 0);
  step.after = {particle};
  EXPECT_EQ(score_of(instances, step).light.followed, 0);
  EXPECT_EQ(score_of(instances, step).heavy.followed, 1);
  EXPECT_EQ(score_of(instances, step).heavy.correct, 0) << "followed, not reported";
}

TEST(BinJudge, ShownIsWhatAnImageSoFarShowsLightlyOccluded) {
  const std::vector<BinInstance> instances{{0, at(0, 0), 0.9, 0.9},
                                           {0, at(0.2, 0), 0.4, 0.71},
                                           {0, at(0, 0.2), 0.4, 0.69},
                                           {0, at(0.2, 0.2), 0.05, 1}};
  const BinScore score = score_of(instances, {});
  EXPECT_EQ(score.light.shown, 1);
  EXPECT_EQ(score.heavy.shown, 1) << "what does not count is not counted here either";
}

}  // namespace
}  // namespace edgescout::test
