// pose_normal_equations on every path: sums within 1e-3 of the system's largest entry
// (pose_normal_equations.h).
#include <algorithm>

#include "kernels/error.h"
#include "tests/kernels/pose_oracle.h"

namespace edgescout {
namespace {

// Entries of one kind share a scale: their largest one.
void expect_near(std::span<const float> found, std::span<const float> expected, const char* what) {
  float largest = 0;
  for (float v : expected) largest = std::max(largest, std::abs(v));
  for (std::size_t i = 0; i < expected.size(); ++i)
    EXPECT_NEAR(found[i], expected[i], 1e-3f * largest + 1e-6f) << what << " " << i;
}

void expect_agreement(const NormalEquations& found, const NormalEquations& expected) {
  expect_near(found.hessian, expected.hessian, "hessian");
  expect_near(found.gradient, expected.gradient, "gradient");
  expect_near({&found.cost, 1}, {&expected.cost, 1}, "cost");
  expect_near({&found.residual_sum, 1}, {&expected.residual_sum, 1}, "residuals");
  expect_near({&found.weight_sum, 1}, {&expected.weight_sum, 1}, "weights");
  EXPECT_EQ(found.points, expected.points);
  EXPECT_EQ(found.behind, expected.behind);
}

class PoseNormalEquationsPaths : public test::PathTest {};

TEST_P(PoseNormalEquationsPaths, AgreesWithTheReference) {
  std::mt19937 rng = test::test_rng();
  const test::TwoViews views = test::make_views(*tested, *reference, rng, false);
  for (const PoseLoss& loss : {PoseLoss{LOSS_HUBER, 4}, PoseLoss{LOSS_GEMAN_MCCLURE, 9}})
    for (const int max_points : {1, 63, 64, 1500}) {
      SCOPED_TRACE("loss " + std::to_string(loss.kind) + ", up to " + std::to_string(max_points) +
                   " points");
      const test::PoseCase c = test::pose_case(rng, views, 40, max_points);
      std::vector<NormalEquations> found(c.problems.size()), expected(c.problems.size());
      tested->pose_normal_equations(views.tested, c.points, c.problems, loss, found);
      reference->pose_normal_equations(views.reference, c.points, c.problems, loss, expected);
      for (std::size_t i = 0; i < found.size(); ++i) {
        SCOPED_TRACE("problem " + std::to_string(i));
        expect_agreement(found[i], expected[i]);
      }
    }
}

// The points go to the device once for both calls; on the narrow device they do not fit.
TEST_P(PoseNormalEquationsPaths, PointsThatStayGiveTheSameSystems) {
  std::mt19937 rng = test::test_rng();
  const test::TwoViews views = test::make_views(*tested, *reference, rng, false);
  const PoseLoss loss{LOSS_HUBER, 4};
  for (const int most : {100, 1500}) {
    const test::PoseCase c = test::pose_case(rng, views, 40, most);
    const PosePointsHandle points = tested->make_pose_points({c.points.begin(), c.points.end()});
    std::vector<NormalEquations> once(c.problems.size()), kept(once.size());
    for (const std::size_t first : {std::size_t(0), c.problems.size() / 2}) {
      const auto problems = std::span(c.problems).subspan(first);
      tested->pose_normal_equations(views.tested, c.points, problems, loss,
                                    std::span(once).subspan(first));
      tested->pose_normal_equations(views.tested, *points, problems, loss,
                                    std::span(kept).subspan(first));
      for (std::size_t i = first; i < once.size(); ++i) {
        EXPECT_TRUE(std::ranges::equal(kept[i].hessian, once[i].hessian)) << i;
        EXPECT_EQ(kept[i].cost, once[i].cost) << i;
      }
    }
  }
  if (GetParam() == test::Path::cpu) return;
  EXPECT_THROW(
      tested->pose_normal_equations(views.tested, *reference->make_pose_points({}), {}, loss, {}),
      LogicError);
}

TEST_P(PoseNormalEquationsPaths, NoProblemsNoPoints) {
  std::mt19937 rng = test::test_rng();
  const test::TwoViews views = test::make_views(*tested, *reference, rng, false);
  tested->pose_normal_equations(views.tested, std::span<const ModelPoint>(), {}, {}, {});
  const PoseProblem empty{test::random_pose(rng, 0.3f), 0, 0, 1};
  NormalEquations found{};
  found.cost = found.points = 7;
  tested->pose_normal_equations(views.tested, std::span<const ModelPoint>(), {&empty, 1}, {},
                                {&found, 1});
  EXPECT_EQ(found.cost, 0);
  EXPECT_EQ(found.points, 0);
}

TEST_P(PoseNormalEquationsPaths, PosesNowhereSeeNothing) {
  std::mt19937 rng = test::test_rng();
  const test::TwoViews views = test::make_views(*tested, *reference, rng, false);
  const std::vector<ModelPoint> points = test::random_points(rng, 70);
  std::vector<PoseProblem> problems;
  for (const Pose& nowhere : test::poses_nowhere(rng)) problems.push_back({nowhere, 0, 70, 0});
  std::vector<NormalEquations> found(problems.size());
  tested->pose_normal_equations(views.tested, points, problems, {LOSS_HUBER, 4}, found);
  NormalEquations nothing{};
  nothing.behind = 70;
  for (std::size_t i = 0; i < found.size(); ++i) {
    SCOPED_TRACE("problem " + std::to_string(i));
    EXPECT_EQ(found[i].behind, 70);
    expect_agreement(found[i], nothing);
  }
}

TEST_P(PoseNormalEquationsPaths, BrokenProblemsAreOurBugs) {
  std::mt19937 rng = test::test_rng();
  const test::TwoViews views = test::make_views(*tested, *reference, rng, false);
  const std::vector<ModelPoint> points = test::random_points(rng, 3);
  NormalEquations out;
  const auto solve = [&](PoseProblem problem) {
    tested->pose_normal_equations(views.tested, points, {&problem, 1}, {}, {&out, 1});
  };
  EXPECT_THROW(solve({test::random_pose(rng, 0.3f), 1, 3, 0}),
               LogicError);  // points beyond the list
  EXPECT_THROW(solve({test::random_pose(rng, 0.3f), 0, 3, 3}),
               LogicError);  // a view that is not there
}

INSTANTIATE_TEST_SUITE_P(Paths, PoseNormalEquationsPaths, test::all_paths, test::param_name);

}  // namespace
}  // namespace edgescout
