// pose_score against an oracle written from pose_score.h's prose alone (pose_oracle.h), and against
// scores worked out by hand.
#include "tests/kernels/pose_oracle.h"

namespace edgescout {
namespace {

using test::Real;

// A score, and how many of its points have a value that float may find on either side of match_px.
struct OracleScore {
  Real mean_px, psi, matched, points, undecided;
};

// Twice the gradient: differences of the neighbours, zero on the border.
std::array<int, 2> gradient_x2(const test::OracleView& view, int x, int y) {
  const int width = view.shape.width, height = view.shape.height;
  if (x == 0 || y == 0 || x == width - 1 || y == height - 1) return {0, 0};
  const auto grey = [&](int column, int row) { return int{view.pixels[row * width + column]}; };
  return {grey(x + 1, y) - grey(x - 1, y), grey(x, y + 1) - grey(x, y - 1)};
}

// |n . g| / |g| at the nearest pixel, 0 where the gradient is too weak.
Real direction_score(const test::OracleView& view, const test::ImagePoint& at, Real min_gradient) {
  const auto [gx, gy] =
      gradient_x2(view, static_cast<int>(std::lround(at.x)), static_cast<int>(std::lround(at.y)));
  const Real twice = std::hypot(Real(gx), Real(gy));
  if (twice < 2 * min_gradient) return 0;
  return std::abs(-std::sin(at.theta) * gx + std::cos(at.theta) * gy) / twice;
}

OracleScore oracle_score(const test::OracleView& view, const Pose& pose,
                         std::span<const ModelPoint> points, const PoseScoreOptions& options) {
  OracleScore sum{};
  for (const ModelPoint& point : points) {
    const test::CameraPoint q = test::in_camera(pose, point);
    if (!test::in_front(q)) continue;
    const test::ImagePoint at = test::project(view.camera, q);
    if (!test::inside(view.shape, at)) continue;
    const Real value = test::tensor_px(view, at);
    sum.mean_px += value;
    sum.psi += direction_score(view, at, options.min_gradient);
    sum.matched += value < options.match_px;
    sum.points += 1;
    sum.undecided += std::abs(value - options.match_px) < 1e-3L;
  }
  if (sum.points == 0) return {options.cap_px, 0, 0, 0, 0};
  return {sum.mean_px / sum.points, sum.psi / sum.points, sum.matched / sum.points, sum.points,
          sum.undecided};
}

void expect_near(const PoseScore& found, const OracleScore& expected) {
  EXPECT_EQ(found.points, expected.points);
  EXPECT_NEAR(found.mean_px, expected.mean_px, 1e-3);
  EXPECT_NEAR(found.psi, expected.psi, 1e-3);
  EXPECT_NEAR(found.matched, expected.matched,
              expected.undecided / std::max<Real>(1, expected.points) + 1e-6);
}

void expect_oracle(Backend& backend) {
  std::mt19937 rng = test::test_rng();
  const test::OracleScene scene = test::make_scene(backend, rng);
  const test::PoseCase c = test::kept_pose_case(rng, scene, test::kept_by_float);
  for (const PoseScoreOptions& options : {PoseScoreOptions{}, PoseScoreOptions{20, 2.5f, 33}}) {
    std::vector<PoseScore> found(c.problems.size());
    backend.pose_score(scene.handles, c.points, c.problems, options, found);
    for (std::size_t i = 0; i < found.size(); ++i) {
      const PoseProblem& problem = c.problems[i];
      SCOPED_TRACE("problem " + std::to_string(i) + ", matched below " +
                   std::to_string(options.match_px));
      expect_near(found[i], oracle_score(scene.views[problem.view], problem.camera_from_object,
                                         test::points_of(c, problem), options));
    }
  }
}

// Points that project onto column 16, rows 2 to 30, their tangents at an angle to the image's x
// axis.
std::vector<ModelPoint> points_on_the_middle(Real degrees) {
  const Real angle = degrees * std::numbers::pi_v<Real> / 180;
  std::vector<ModelPoint> points;
  for (int y = 2; y <= 30; ++y)
    points.push_back(
        {0, 0.1f * float(y - 16), 0, float(std::cos(angle)), float(std::sin(angle)), 0});
  return points;
}

PoseScore score_of(Backend& backend, const ViewHandle& view, std::span<const ModelPoint> points) {
  const PoseProblem problem{test::ahead, 0, static_cast<std::uint32_t>(points.size()), 0};
  PoseScore score{};
  backend.pose_score({&view, 1}, points, {&problem, 1}, {}, {&score, 1});
  return score;
}

// Dark on the left, brighter by `step` from column 16 on.
std::vector<std::uint8_t> step_image(int step) {
  std::vector<std::uint8_t> pixels;
  for (int i = 0; i < 33 * 33; ++i)
    pixels.push_back(static_cast<std::uint8_t>(20 + (i % 33 < 16 ? 0 : step)));
  return pixels;
}

// Along the edge Psi is 1 and the tensor 0; turned, Psi is the cosine and the tensor grows by a bin
// every three degrees. Matched below 6 px: up to 11 degrees.
void expect_turned_scores(Backend& backend) {
  const std::vector<std::uint8_t> pixels = step_image(100);
  const ViewHandle view = test::straight_edge(backend, true, {33, 33, pixels.data()});
  for (const int turn : {0, 3, -6, 9, -9, 12, 30, -45, 60, 87, -90, 90}) {
    SCOPED_TRACE("turned by " + std::to_string(turn));
    const PoseScore score = score_of(backend, view, points_on_the_middle(90 + turn));
    EXPECT_EQ(score.points, 29);
    EXPECT_NEAR(score.psi, std::cos(turn * std::numbers::pi_v<Real> / 180), 1e-3);
    EXPECT_NEAR(score.mean_px, std::abs(turn) / 3.0L * test::bin_px, 1e-3);
    EXPECT_EQ(score.matched, std::abs(turn) < 11);
  }
}

// A step of 4 grey levels has a gradient of just 2 a pixel, the least that counts.
void expect_weak_steps_count_zero(Backend& backend) {
  for (const int step : {0, 3, 4, 5}) {
    SCOPED_TRACE("step of " + std::to_string(step));
    const std::vector<std::uint8_t> pixels = step_image(step);
    const ViewHandle view = test::straight_edge(backend, true, {33, 33, pixels.data()});
    EXPECT_NEAR(score_of(backend, view, points_on_the_middle(90)).psi, step >= 4, 1e-3);
  }
}

// Between the last bin and the first: an edge of angle 0 seen by tangents to either side of it. Row
// 16 is one of 29, the others lie their distance away.
void expect_wrap_at_pi(Backend& backend) {
  const std::vector<std::uint8_t> pixels = step_image(0);
  const ViewHandle view = test::straight_edge(backend, false, {33, 33, pixels.data()});
  const Real rows = 14 * 15 / 29.0L;
  for (const Real degrees :
       {-4.5L, -3.0L, -1.5L, -0.75L, 0.0L, 0.75L, 1.5L, 4.5L, 178.5L, 181.5L}) {
    SCOPED_TRACE("angle " + std::to_string(degrees));
    const Real turn = std::abs(degrees > 90 ? degrees - 180 : degrees);
    EXPECT_NEAR(score_of(backend, view, points_on_the_middle(degrees)).mean_px,
                rows + turn / 3 * test::bin_px, 1e-3);
  }
}

void expect_known_answers(Backend& backend) {
  expect_turned_scores(backend);
  expect_weak_steps_count_zero(backend);
  expect_wrap_at_pi(backend);
}

class PoseScoreOracle : public test::PathTest {};

TEST_P(PoseScoreOracle, AgreesWithTheProse) { expect_oracle(*tested); }
TEST_P(PoseScoreOracle, KnownAnswers) { expect_known_answers(*tested); }

INSTANTIATE_TEST_SUITE_P(Paths, PoseScoreOracle, test::all_paths, test::param_name);

TEST(PoseScoreOracleOfReference, AgreesWithTheProse) { expect_oracle(*make_reference_backend()); }
TEST(PoseScoreOracleOfReference, KnownAnswers) { expect_known_answers(*make_reference_backend()); }

}  // namespace
}  // namespace edgescout
