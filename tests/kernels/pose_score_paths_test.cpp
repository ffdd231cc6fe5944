// pose_score on every path (pose_score.h).
#include "kernels/error.h"
#include "tests/kernels/pose_oracle.h"

namespace edgescout {
namespace {

class PoseScorePaths : public test::PathTest {};

TEST_P(PoseScorePaths, AgreesWithTheReference) {
  std::mt19937 rng = test::test_rng();
  for (const bool with_image : {true, false}) {
    const test::TwoViews views = test::make_views(*tested, *reference, rng, with_image);
    for (const int max_points : {1, 64, 1500}) {
      const test::PoseCase c = test::pose_case(rng, views, 40, max_points);
      std::vector<PoseScore> found(c.problems.size()), expected(c.problems.size());
      tested->pose_score(views.tested, c.points, c.problems, {}, found);
      reference->pose_score(views.reference, c.points, c.problems, {}, expected);
      for (std::size_t i = 0; i < found.size(); ++i) {
        SCOPED_TRACE("problem " + std::to_string(i) + ", up to " + std::to_string(max_points) +
                     " points");
        EXPECT_EQ(found[i].points, expected[i].points);
        EXPECT_NEAR(found[i].mean_px, expected[i].mean_px, 1e-3f);
        EXPECT_NEAR(found[i].psi, expected[i].psi, 1e-3f);
        EXPECT_NEAR(found[i].matched, expected[i].matched, 2 / std::max(1.0f, expected[i].points));
      }
    }
  }
}

TEST_P(PoseScorePaths, NothingInsideScoresTheCap) {
  std::mt19937 rng = test::test_rng();
  const test::TwoViews views = test::make_views(*tested, *reference, rng, true);
  const std::vector<ModelPoint> points = test::random_points(rng, 10);
  Pose away = test::random_pose(rng, 0.3f), behind = away;
  away.m[3] = 5;
  behind.m[11] = -1;
  std::vector<PoseProblem> problems{{away, 0, 10, 0}, {behind, 0, 10, 0}};
  for (const Pose& nowhere : test::poses_nowhere(rng)) problems.push_back({nowhere, 0, 10, 0});
  std::vector<PoseScore> found(problems.size());
  PoseScoreOptions options;
  options.cap_px = 17;
  tested->pose_score(views.tested, points, problems, options, found);
  for (const PoseScore& score : found) {
    EXPECT_EQ(score.mean_px, 17);
    EXPECT_EQ(score.psi, 0);
    EXPECT_EQ(score.matched, 0);
    EXPECT_EQ(score.points, 0);
  }
}

TEST_P(PoseScorePaths, BrokenProblemsAreOurBugs) {
  std::mt19937 rng = test::test_rng();
  const test::TwoViews views = test::make_views(*tested, *reference, rng, true);
  const std::vector<ModelPoint> points = test::random_points(rng, 3);
  PoseScore out;
  const auto score = [&](PoseProblem problem) {
    tested->pose_score(views.tested, points, {&problem, 1}, {}, {&out, 1});
    reference->pose_score(views.reference, points, {&problem, 1}, {}, {&out, 1});
  };
  EXPECT_NO_THROW(score({test::random_pose(rng, 0.3f), 0, 3, 0}));
  EXPECT_THROW(score({test::random_pose(rng, 0.3f), 1, 3, 0}),
               LogicError);  // points beyond the list
  EXPECT_THROW(score({test::random_pose(rng, 0.3f), 0, 3, 3}),
               LogicError);  // a view that is not there
}

TEST_P(PoseScorePaths, AnImageOfAnotherSizeIsOurBug) {
  const std::vector<std::uint8_t> pixels(16 * 12, 0);
  EXPECT_THROW(tested->make_view({}, 32, 24, {16, 12, pixels.data()}, {100, 100, 15.5f, 11.5f}, {}),
               LogicError);
}

INSTANTIATE_TEST_SUITE_P(Paths, PoseScorePaths, test::all_paths, test::param_name);

}  // namespace
}  // namespace edgescout
