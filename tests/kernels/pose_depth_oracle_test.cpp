// pose_depth against an oracle written from pose_depth.h's prose alone (pose_depth_oracle.h), whose
// derivatives are differences of its residuals and costs, and against cases worked out by hand.
#include <map>

#include "kernels/error.h"
#include "tests/kernels/pose_depth_oracle.h"

namespace edgescout {
namespace {

using test::DepthVerdict;
using test::Real;
using test::Real3;

struct OracleDepth {
  std::array<Real, 21> hessian{};
  std::array<Real, 6> gradient{};
  Real cost = 0, weight_sum = 0, offset_m = 0;
  std::map<DepthVerdict, int> counts;
};

Real depth_rho(Real k, Real r) { return k * k / 2 * r * r / (k * k + r * r); }

// After a small move of the pose; what was measured and its uncertainty stay.
Real moved_residual(const test::DepthLook& look, const test::CameraPoint& p, int direction,
                    Real by) {
  const test::CameraPoint at = test::moved(p, direction, by);
  return test::dot(at.tangent, test::plus(look.measured, test::times(-1, at.position))) /
         look.scale;
}

void add_residual(OracleDepth& sum, const test::DepthLook& look, const test::CameraPoint& p,
                  Real k) {
  constexpr Real h = 1e-8L;
  const Real r = moved_residual(look, p, 0, 0);
  const Real w = k * k * k * k / ((k * k + r * r) * (k * k + r * r));
  std::array<Real, 6> jacobian;
  for (int i = 0; i < 6; ++i) {
    const Real more = moved_residual(look, p, i, h), less = moved_residual(look, p, i, -h);
    jacobian[i] = (more - less) / (2 * h);
    sum.gradient[i] += (depth_rho(k, more) - depth_rho(k, less)) / (2 * h);
  }
  for (int i = 0, entry = 0; i < 6; ++i)
    for (int j = i; j < 6; ++j) sum.hessian[entry++] += w * jacobian[i] * jacobian[j];
  sum.cost += depth_rho(k, r);
  sum.weight_sum += w;
  sum.offset_m += w * look.offset;
}

OracleDepth oracle_depth(const DepthView& view, const Pose& pose,
                         std::span<const SurfacePoint> points, const PoseDepthOptions& options) {
  OracleDepth sum;
  for (const SurfacePoint& point : points) {
    const test::CameraPoint p = test::in_camera(pose, point);
    const test::DepthLook look = test::look_at(view, p, options);
    ++sum.counts[look.verdict];
    if (look.verdict == DepthVerdict::agreeing || look.verdict == DepthVerdict::contradicting)
      add_residual(sum, look, p, options.loss_scale);
  }
  return sum;
}

// Entries of one kind share a scale: their largest one. Both sides keep many more digits than the
// results.
void expect_close(std::span<const float> found, std::span<const Real> expected, const char* what) {
  Real largest = 0;
  for (const Real v : expected) largest = std::max(largest, std::abs(v));
  for (std::size_t i = 0; i < expected.size(); ++i)
    EXPECT_NEAR(found[i], expected[i], 1e-6L * largest + 1e-9L) << what << " " << i;
}

void expect_close(const PoseDepth& found, OracleDepth expected) {
  expect_close(found.hessian, expected.hessian, "hessian");
  expect_close(found.gradient, expected.gradient, "gradient");
  expect_close({&found.cost, 1}, {&expected.cost, 1}, "cost");
  expect_close({&found.weight_sum, 1}, {&expected.weight_sum, 1}, "weights");
  expect_close({&found.offset_m, 1}, {&expected.offset_m, 1}, "offsets");
  EXPECT_EQ(found.agreeing, expected.counts[DepthVerdict::agreeing]);
  EXPECT_EQ(found.contradicting, expected.counts[DepthVerdict::contradicting]);
  EXPECT_EQ(found.hidden, expected.counts[DepthVerdict::hidden]);
  EXPECT_EQ(found.missing, expected.counts[DepthVerdict::missing]);
}

TEST(PoseDepthOracle, AgreesWithTheReference) {
  std::mt19937 rng = test::test_rng();
  const auto backend = make_reference_backend();
  const test::DepthScene scene = test::make_depth_scene(rng);
  std::map<DepthVerdict, int> seen;
  for (const PoseDepthOptions& options :
       {PoseDepthOptions{}, PoseDepthOptions{3e-3f, 0.05f, 0, 0, 10}}) {
    const test::DepthCase c = test::depth_case(rng, scene, options, 24, 300);
    std::vector<PoseDepth> found(c.problems.size());
    backend->pose_depth(scene.in(*backend),
                        *backend->make_surface_points({c.points.begin(), c.points.end()}),
                        c.problems, options, found);
    for (std::size_t i = 0; i < found.size(); ++i) {
      SCOPED_TRACE("problem " + std::to_string(i) + ", band " + std::to_string(options.band_m));
      const PoseProblem& problem = c.problems[i];
      const OracleDepth expected = oracle_depth(
          scene.views[problem.view], problem.camera_from_object, c.points_of(problem), options);
      for (const auto& [verdict, count] : expected.counts) seen[verdict] += count;
      expect_close(found[i], expected);
    }
  }
  for (const DepthVerdict verdict :
       {DepthVerdict::uncounted, DepthVerdict::missing, DepthVerdict::hidden,
        DepthVerdict::contradicting, DepthVerdict::agreeing})
    EXPECT_GT(seen[verdict], 100) << "of kind " << int(verdict);
}

// A view of 17 x 9 px. Points lie a metre ahead; 1/64 m is a pixel.
struct HandDepth {
  std::unique_ptr<Backend> backend = make_reference_backend();
  std::vector<float> values = std::vector<float>(17 * 9, 1.0f);
  Intrinsics camera{64, 64, 8, 4};
  PoseDepthOptions options;

  PoseDepth of(const SurfacePoint& point, const Pose& pose = test::ahead) const {
    const DepthHandle view = backend->make_depth({values, 17, 9, camera});
    const PoseProblem problem{pose, 0, 1, 0};
    PoseDepth out;
    backend->pose_depth({&view, 1}, *backend->make_surface_points({point}), {&problem, 1}, options,
                        {&out, 1});
    return out;
  }
  // Of a point that faces the camera.
  PoseDepth at(float x_m, float y_m) const { return of({x_m, y_m, 0, 0, 0, -1}); }
  void fill(float depth_m) { std::ranges::fill(values, depth_m); }
};

// agreeing, contradicting, hidden, missing
using Verdicts = std::array<float, 4>;
Verdicts verdicts(const PoseDepth& d) { return {d.agreeing, d.contradicting, d.hidden, d.missing}; }
constexpr Verdicts not_counted{0, 0, 0, 0}, is_agreeing{1, 0, 0, 0}, is_contradicting{0, 1, 0, 0},
    is_hidden{0, 0, 1, 0}, is_missing{0, 0, 0, 1};

// 4 px right of the centre, where a surface 2 mm behind was measured.
TEST(PoseDepthByHand, ThePointAndItsSystem) {
  HandDepth hand;
  hand.fill(1.002f);
  const PoseDepth found = hand.at(4 / 64.0f, 0);
  EXPECT_EQ(verdicts(found), is_agreeing);
  const Real d = 1.002f, s = std::hypot(1e-3L * d * d, 2e-4L), r = -(d - 1) / s;
  const Real q = 9 / (9 + r * r), w = q * q, turn = -d * 4 / 64 / s;
  EXPECT_NEAR(found.cost, q * r * r / 2, 1e-5);
  EXPECT_NEAR(found.weight_sum, w, 1e-6);
  EXPECT_NEAR(found.offset_m, w * (d - 1), 1e-8);
  // The pose falls in cost as it moves away from the camera.
  OracleDepth system;
  const std::array<Real, 6> jacobian{0, 0, 1 / s, 0, turn, 0};
  for (int i = 0, entry = 0; i < 6; ++i) {
    system.gradient[i] = w * r * jacobian[i];
    for (int j = i; j < 6; ++j) system.hessian[entry++] = w * jacobian[i] * jacobian[j];
  }
  expect_close(found.hessian, system.hessian, "hessian");
  expect_close(found.gradient, system.gradient, "gradient");
  EXPECT_LT(found.gradient[2], 0);
}

TEST(PoseDepthByHand, OffsetsAtTheBandsBorderAgree) {
  HandDepth hand;
  hand.options.band_m = 0.25f;
  for (const auto& [depth, expected] :
       {std::pair{1.25f, is_agreeing}, std::pair{std::nextafter(1.25f, 2.0f), is_contradicting},
        std::pair{0.75f, is_agreeing}, std::pair{std::nextafter(0.75f, 0.0f), is_hidden}}) {
    hand.fill(depth);
    const PoseDepth found = hand.at(0, 0);
    EXPECT_EQ(verdicts(found), expected) << depth;
    EXPECT_EQ(found.cost > 0, expected != is_hidden) << depth;
    EXPECT_EQ(found.weight_sum > 0, expected != is_hidden) << depth;
  }
  // A wider one is that of the noise: 4 sigma of 1/8 m.
  hand.options.noise_floor_m = 0.125f;
  for (const auto& [depth, expected] :
       {std::pair{1.5f, is_agreeing}, std::pair{1.51f, is_contradicting},
        std::pair{0.49f, is_hidden}}) {
    hand.fill(depth);
    EXPECT_EQ(verdicts(hand.at(0, 0)), expected) << depth;
  }
}

TEST(PoseDepthByHand, NothingMeasuredIsMissing) {
  HandDepth hand;
  for (const float depth : {0.0f, -1.0f, 10000.0f, INFINITY}) {
    hand.fill(depth);
    const PoseDepth found = hand.at(0, 0);
    EXPECT_EQ(verdicts(found), is_missing) << depth;
    EXPECT_EQ(found.cost, 0) << depth;
    EXPECT_EQ(found.weight_sum, 0) << depth;
  }
}

// The nearest pixel, half up: the first pixel begins at -0.5, what lies at 16.5 belongs to the
// 18th.
TEST(PoseDepthByHand, PixelsBeginAtTheirLeftAndUpperBorder) {
  HandDepth hand;
  const float near = 1 / 4096.0f;
  const std::array<Verdicts, 2> inside_outside{is_agreeing, is_missing};
  for (const bool out : {false, true}) {
    const float left = -8.5f / 64 - (out ? near : 0), right = 8.5f / 64 - (out ? 0 : near);
    const float top = -4.5f / 64 - (out ? near : 0), bottom = 4.5f / 64 - (out ? 0 : near);
    for (const auto& [x, y] : {std::pair{left, 0.0f}, std::pair{right, 0.0f}, std::pair{0.0f, top},
                               std::pair{0.0f, bottom}})
      EXPECT_EQ(verdicts(hand.at(x, y)), inside_outside[out]) << x << " " << y;
  }
  hand.values[4 * 17 + 9] = 0;  // right of the centre
  EXPECT_EQ(verdicts(hand.at(0.5f / 64, 0)), is_missing);
  EXPECT_EQ(verdicts(hand.at(0.5f / 64 - near, 0)), is_agreeing);
  EXPECT_EQ(verdicts(hand.of({1e3f, 0, 0, -1, 0, 0})), is_missing) << "far outside";
}

TEST(PoseDepthByHand, WhatIsNotSeenIsNotCounted) {
  const HandDepth hand;
  const auto turned_by = [&](float cosine) {
    return verdicts(hand.of({0, 0, 0, std::sqrt(1 - cosine * cosine), 0, -cosine}));
  };
  EXPECT_EQ(turned_by(-1), not_counted);
  EXPECT_EQ(turned_by(0.099f), not_counted);
  EXPECT_EQ(turned_by(0.101f), is_agreeing);
  const auto at_depth = [&](float z_m) {  // of the object's origin
    Pose pose = test::ahead;
    pose.m[11] = z_m;
    return verdicts(hand.of({0, 0, 0, 0, 0, -1}, pose));
  };
  EXPECT_EQ(at_depth(-1), not_counted);
  EXPECT_EQ(at_depth(0), not_counted);
  EXPECT_EQ(at_depth(POSE_MIN_DEPTH_M), not_counted);
  EXPECT_EQ(at_depth(2 * POSE_MIN_DEPTH_M), is_contradicting);
  EXPECT_EQ(at_depth(9999), is_hidden);
  EXPECT_EQ(at_depth(10000), not_counted);
  EXPECT_EQ(at_depth(NAN), not_counted);
  EXPECT_EQ(verdicts(hand.of({-1e5f, 0, 0, 1, 0, 0})), not_counted) << "beside all range";
}

// It faces the camera; the ray through its pixel's centre passes it from behind.
TEST(PoseDepthByHand, ThePixelsRayRunsAlongThePlane) {
  HandDepth hand;
  hand.camera = {2, 2, 8, 4};
  EXPECT_EQ(verdicts(hand.of({0.2f, 0, 0, -1, 0, 0})), is_missing);
  EXPECT_EQ(verdicts(hand.of({0.2f, 0, 0, -0.8f, 0, -0.6f})), is_hidden);
  EXPECT_EQ(verdicts(hand.of({0.2f, 0, 0, -0.998f, 0, 0.06f})), is_missing) << "n . ray > 0";
}

TEST(PoseDepthByHand, BrokenArgumentsAreOurBugs) {
  const HandDepth hand;
  for (const DepthView& view :
       {DepthView{hand.values, 17, 8, hand.camera}, DepthView{hand.values, -17, -9, hand.camera},
        DepthView{{}, 0, 0, hand.camera}})
    EXPECT_THROW(hand.backend->make_depth(view), LogicError) << view.width << "x" << view.height;
  for (float PoseDepthOptions::*option :
       {&PoseDepthOptions::noise_floor_m, &PoseDepthOptions::noise_per_m,
        &PoseDepthOptions::surface_m, &PoseDepthOptions::band_m, &PoseDepthOptions::loss_scale})
    for (const float value : {-1.0f, NAN, INFINITY}) {
      HandDepth broken;
      broken.options.*option = value;
      EXPECT_THROW(broken.at(0, 0), LogicError) << value;
    }
  for (float PoseDepthOptions::*option :
       {&PoseDepthOptions::noise_floor_m, &PoseDepthOptions::loss_scale}) {
    HandDepth broken;
    broken.options.*option = 0;
    EXPECT_THROW(broken.at(0, 0), LogicError);
  }
}

}  // namespace
}  // namespace edgescout
