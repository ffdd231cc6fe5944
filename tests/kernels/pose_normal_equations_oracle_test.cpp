// pose_normal_equations against an oracle written from pose_normal_equations.h's prose alone
// (pose_oracle.h), whose derivatives are differences of its residuals and costs, and against
// systems worked out by hand.
#include "tests/kernels/pose_oracle.h"

namespace edgescout {
namespace {

using test::Real;

struct OracleSystem {
  std::array<Real, 21> hessian{};
  std::array<Real, 6> gradient{};
  Real cost = 0, residual_sum = 0, weight_sum = 0, points = 0, behind = 0;
};

Real rho(const PoseLoss& loss, Real r) {
  const Real s = loss.scale_px;
  if (loss.kind == LOSS_GEMAN_MCCLURE) return s * s / 2 * r * r / (s * s + r * r);
  return r <= s ? r * r / 2 : s * (r - s / 2);
}

// rho'(r) / r, by hand.
Real weight(const PoseLoss& loss, Real r) {
  const Real s = loss.scale_px;
  if (loss.kind == LOSS_GEMAN_MCCLURE) return s * s * s * s / ((s * s + r * r) * (s * s + r * r));
  return r <= s ? 1 : s / r;
}

// The residual after a small move. An edge seen end on keeps its orientation: its derivative counts
// as zero.
Real moved_residual(const test::OracleView& view, const test::CameraPoint& q, int direction,
                    Real by) {
  const test::ImagePoint before = test::project(view.camera, q);
  test::ImagePoint at = test::project(view.camera, test::moved(q, direction, by));
  if (before.foreshortening < POSE_MIN_FORESHORTENING) at.theta = before.theta;
  return test::tensor_px(view, at);
}

void add_point(OracleSystem& system, const test::OracleView& view, const PoseLoss& loss,
               const test::CameraPoint& q) {
  const Real r = test::tensor_px(view, test::project(view.camera, q)), w = weight(loss, r);
  const Real h = 1e-6L * q.position[2];  // well below the clearance of the seams
  std::array<Real, 6> jacobian;
  for (int i = 0; i < 6; ++i) {
    const Real more = moved_residual(view, q, i, h), less = moved_residual(view, q, i, -h);
    jacobian[i] = (more - less) / (2 * h);
    system.gradient[i] += (rho(loss, more) - rho(loss, less)) / (2 * h);
  }
  for (int i = 0, entry = 0; i < 6; ++i)
    for (int j = i; j < 6; ++j) system.hessian[entry++] += w * jacobian[i] * jacobian[j];
  system.cost += rho(loss, r);
  system.residual_sum += r;
  system.weight_sum += w;
  system.points += 1;
}

OracleSystem oracle_system(const test::OracleView& view, const Pose& pose,
                           std::span<const ModelPoint> points, const PoseLoss& loss) {
  OracleSystem system;
  for (const ModelPoint& point : points) {
    const test::CameraPoint q = test::in_camera(pose, point);
    if (test::in_front(q))
      add_point(system, view, loss, q);
    else
      system.behind += 1;
  }
  return system;
}

// Entries of one kind share a scale: their largest one.
void expect_near(std::span<const float> found, std::span<const Real> expected, const char* what) {
  Real largest = 0;
  for (const Real v : expected) largest = std::max(largest, std::abs(v));
  for (std::size_t i = 0; i < expected.size(); ++i)
    EXPECT_NEAR(found[i], expected[i], 1e-3L * largest + 1e-6L) << what << " " << i;
}

void expect_near(const NormalEquations& found, const OracleSystem& expected) {
  expect_near(found.hessian, expected.hessian, "hessian");
  expect_near(found.gradient, expected.gradient, "gradient");
  expect_near({&found.cost, 1}, {&expected.cost, 1}, "cost");
  expect_near({&found.residual_sum, 1}, {&expected.residual_sum, 1}, "residuals");
  expect_near({&found.weight_sum, 1}, {&expected.weight_sum, 1}, "weights");
  EXPECT_EQ(found.points, expected.points);
  EXPECT_EQ(found.behind, expected.behind);
}

// Clearly seen from the side or clearly end on, though not so much that float loses the
// orientation.
bool derivative_is_sure(const TensorShape& shape, const Intrinsics& camera,
                        const test::CameraPoint& q) {
  if (!test::clear_of_seams(shape, camera, q)) return false;
  if (!test::in_front(q)) return true;
  const Real seen = test::project(camera, q).foreshortening / POSE_MIN_FORESHORTENING;
  return seen > 1.2L || (seen > 0.4L && seen < 0.8L);
}

void expect_oracle(Backend& backend) {
  std::mt19937 rng = test::test_rng();
  const test::OracleScene scene = test::make_scene(backend, rng);
  const test::PoseCase c = test::kept_pose_case(rng, scene, derivative_is_sure);
  for (const PoseLoss& loss : {PoseLoss{LOSS_HUBER, 4}, PoseLoss{LOSS_GEMAN_MCCLURE, 9}}) {
    std::vector<NormalEquations> found(c.problems.size());
    backend.pose_normal_equations(scene.handles, c.points, c.problems, loss, found);
    for (std::size_t i = 0; i < found.size(); ++i) {
      const PoseProblem& problem = c.problems[i];
      SCOPED_TRACE("problem " + std::to_string(i) + ", loss " + std::to_string(loss.kind));
      expect_near(found[i], oracle_system(scene.views[problem.view], problem.camera_from_object,
                                          test::points_of(c, problem), loss));
    }
  }
}

NormalEquations system_of(Backend& backend, const ViewHandle& view, const ModelPoint& point,
                          const PoseLoss& loss) {
  const PoseProblem problem{test::ahead, 0, 1, 0};
  NormalEquations system{};
  backend.pose_normal_equations({&view, 1}, {&point, 1}, {&problem, 1}, loss, {&system, 1});
  return system;
}

// 3.5 px right of the edge and half a bin beyond its orientation. By x the tensor grows by 1 px/px,
// by orientation by a bin's step in pi / 60. A metre to the right is 10 px, a metre ahead -3.5 px;
// the rotations turn the tangent's image by 0.35 ty^2, -0.35 tx ty and 1.
void expect_system_beside_the_edge(Backend& backend) {
  const Real half_turn = std::numbers::pi_v<Real>, angle = half_turn / 2 + half_turn / 120;
  const Real tx = std::cos(angle), ty = std::sin(angle), turn = test::bin_px * 60 / half_turn;
  const Real r = 3.5L + test::bin_px / 2;
  const std::array<Real, 6> jacobian{
      10, 0, -3.5L, turn * 0.35L * ty * ty, 1.225L - turn * 0.35L * tx * ty, turn};
  OracleSystem expected{{}, {}, r * r / 2, r, 1, 1, 0};
  for (int i = 0, entry = 0; i < 6; ++i) {
    expected.gradient[i] = r * jacobian[i];
    for (int j = i; j < 6; ++j) expected.hessian[entry++] = jacobian[i] * jacobian[j];
  }
  const ViewHandle view = test::straight_edge(backend, true, {});
  expect_near(system_of(backend, view, {0.35f, 0, 0, float(tx), float(ty), 0}, {LOSS_HUBER, 10}),
              expected);
}

// 3.5 px left of the image, whose border lies 16 px from the edge: the residual is 19.5 px and
// grows outwards.
void expect_system_outside_the_image(Backend& backend) {
  const ViewHandle view = test::straight_edge(backend, true, {});
  const ModelPoint point{-1.95f, 0, 0, 0, 1, 0};
  const NormalEquations huber = system_of(backend, view, point, {LOSS_HUBER, 2});
  EXPECT_NEAR(huber.residual_sum, 19.5, 1e-3);
  EXPECT_NEAR(huber.cost, 2 * (19.5 - 1), 1e-2);
  EXPECT_NEAR(huber.weight_sum, 2 / 19.5, 1e-4);
  EXPECT_NEAR(huber.gradient[0], 2 * -10, 0.02);
  EXPECT_NEAR(huber.gradient[1], 0, 0.02);
  EXPECT_NEAR(huber.gradient[2], 2 * -19.5, 0.02);
  const NormalEquations forgetful = system_of(backend, view, point, {LOSS_GEMAN_MCCLURE, 6.5f});
  EXPECT_NEAR(forgetful.cost, 6.5 * 6.5 / 2 * 0.9, 1e-2);  // r = 3 s
  EXPECT_NEAR(forgetful.weight_sum, 0.01, 1e-5);
  EXPECT_NEAR(forgetful.gradient[0], 0.01 * 19.5 * -10, 0.002);
}

void expect_behind_counted(Backend& backend) {
  struct Place {
    Pose pose;
    bool behind;
  };
  const auto at = [](float x, float y, float z) {
    return Pose{{1, 0, 0, x, 0, 1, 0, y, 0, 0, 1, z}};
  };
  const ViewHandle view = test::straight_edge(backend, true, {});
  const ModelPoint point{0, 0, 0, 0, 1, 0};
  for (const Place& place : std::vector<Place>{{at(0, 0, POSE_MIN_DEPTH_M), true},
                                               {at(0, 0, 0.0009f), true},
                                               {at(0, 0, -1), true},
                                               {at(0, 0, 0.0011f), false},
                                               {at(0, 0, 9999), false},
                                               {at(0, 0, 10001), true},
                                               {at(9999, -9999, 1), false},
                                               {at(-10001, 0, 1), true},
                                               {at(0, 10001, 1), true}}) {
    SCOPED_TRACE("at " + std::to_string(place.pose.m[3]) + ", " + std::to_string(place.pose.m[7]) +
                 ", " + std::to_string(place.pose.m[11]));
    const PoseProblem problem{place.pose, 0, 1, 0};
    NormalEquations system{};
    backend.pose_normal_equations({&view, 1}, {&point, 1}, {&problem, 1}, {}, {&system, 1});
    EXPECT_EQ(system.behind, place.behind);
    EXPECT_EQ(system.points, !place.behind);
  }
}

void expect_known_answers(Backend& backend) {
  expect_system_beside_the_edge(backend);
  expect_system_outside_the_image(backend);
  expect_behind_counted(backend);
}

class PoseNormalEquationsOracle : public test::PathTest {};

TEST_P(PoseNormalEquationsOracle, AgreesWithTheProse) { expect_oracle(*tested); }
TEST_P(PoseNormalEquationsOracle, KnownAnswers) { expect_known_answers(*tested); }

INSTANTIATE_TEST_SUITE_P(Paths, PoseNormalEquationsOracle, test::all_paths, test::param_name);

TEST(PoseNormalEquationsOracleOfReference, AgreesWithTheProse) {
  expect_oracle(*make_reference_backend());
}
TEST(PoseNormalEquationsOracleOfReference, KnownAnswers) {
  expect_known_answers(*make_reference_backend());
}

}  // namespace
}  // namespace edgescout
