// pose_depth on every path: counts equal, sums within 1e-3 of the system's largest entry and what
// float makes of the residuals (pose_depth.h).
#include <algorithm>

#include "kernels/error.h"
#include "tests/kernels/pose_depth_oracle.h"

namespace edgescout {
namespace {

// Of a residual, in standard deviations: float's part at 0.4 m, where the surfaces of the scene
// lie, by the smallest s.
constexpr float residual_slack = 4e-7f * 0.4f / 2e-4f;

void expect_sums_near(std::span<const float> found, std::span<const float> expected, float slack,
                      const char* what) {
  float largest = 0;
  for (const float v : expected) largest = std::max(largest, std::abs(v));
  for (std::size_t i = 0; i < expected.size(); ++i)
    EXPECT_NEAR(found[i], expected[i], 1e-3f * largest + slack + 1e-9f) << what << " " << i;
}

// The largest change of a sum of w r J, by Cauchy and Schwarz.
float gradient_slack(const PoseDepth& d) {
  float largest = 0;
  for (const int diagonal : {0, 6, 11, 15, 18, 20})
    largest = std::max(largest, d.hessian[diagonal]);
  return residual_slack * std::sqrt(largest * d.weight_sum);
}

void expect_agreement(const PoseDepth& found, const PoseDepth& expected) {
  EXPECT_EQ(found.agreeing, expected.agreeing);
  EXPECT_EQ(found.contradicting, expected.contradicting);
  EXPECT_EQ(found.hidden, expected.hidden);
  EXPECT_EQ(found.missing, expected.missing);
  expect_sums_near(found.hessian, expected.hessian, 0, "hessian");
  expect_sums_near(found.gradient, expected.gradient, gradient_slack(expected), "gradient");
  expect_sums_near({&found.cost, 1}, {&expected.cost, 1},
                   residual_slack * std::sqrt(2 * expected.cost * expected.weight_sum), "cost");
  expect_sums_near({&found.weight_sum, 1}, {&expected.weight_sum, 1}, 0, "weights");
  expect_sums_near({&found.offset_m, 1}, {&expected.offset_m, 1},
                   2e-6f * 0.4f * expected.weight_sum, "offsets");
}

void expect_same(std::span<const PoseDepth> found, std::span<const PoseDepth> expected) {
  for (std::size_t i = 0; i < found.size(); ++i) {
    SCOPED_TRACE("problem " + std::to_string(i));
    expect_agreement(found[i], expected[i]);
  }
}

class PoseDepthPaths : public test::PathTest {
 protected:
  static std::vector<PoseDepth> sums(Backend& backend, const test::DepthScene& scene,
                                     const test::DepthCase& c, const PoseDepthOptions& options) {
    std::vector<PoseDepth> out(c.problems.size());
    backend.pose_depth(scene.in(backend),
                       *backend.make_surface_points({c.points.begin(), c.points.end()}), c.problems,
                       options, out);
    return out;
  }
};

TEST_P(PoseDepthPaths, AgreesWithTheReference) {
  std::mt19937 rng = test::test_rng();
  const test::DepthScene scene = test::make_depth_scene(rng);
  for (const PoseDepthOptions& options :
       {PoseDepthOptions{}, PoseDepthOptions{3e-3f, 0.05f, 1e-3f, 0, 10}})
    for (const int max_points : {1, 63, 64, 1500}) {
      SCOPED_TRACE("band " + std::to_string(options.band_m) + ", up to " +
                   std::to_string(max_points) + " points");
      const test::DepthCase c = test::depth_case(rng, scene, options, 40, max_points);
      expect_same(sums(*tested, scene, c, options), sums(*reference, scene, c, options));
    }
}

// The points stay over the steps of a registration, whose problems may be any of those they serve.
TEST_P(PoseDepthPaths, HandlesServeSeveralCalls) {
  std::mt19937 rng = test::test_rng();
  const test::DepthScene scene = test::make_depth_scene(rng);
  const PoseDepthOptions options;
  const test::DepthCase c = test::depth_case(rng, scene, options, 9, 100);
  const std::vector<PoseDepth> expected = sums(*reference, scene, c, options);
  const SurfacePointsHandle points =
      tested->make_surface_points({c.points.begin(), c.points.end()});
  const std::vector<DepthHandle> views = scene.in(*tested);
  EXPECT_EQ(views[1]->width, 33);
  EXPECT_EQ(views[1]->height, 17);
  EXPECT_EQ(views[1]->intrinsics.fy, 250);
  for (const std::size_t first : {0, 4, 8}) {
    std::vector<PoseDepth> found(c.problems.size() - first);
    tested->pose_depth(views, *points, std::span(c.problems).subspan(first), options, found);
    expect_same(found, std::span(expected).subspan(first));
  }
}

TEST_P(PoseDepthPaths, NoProblemsNoPoints) {
  std::mt19937 rng = test::test_rng();
  const test::DepthScene scene = test::make_depth_scene(rng);
  const SurfacePointsHandle none = tested->make_surface_points({});
  tested->pose_depth({}, *none, {}, {}, {});
  const PoseProblem empty{test::random_pose(rng, 0.3f), 0, 0, 1};
  PoseDepth found{};
  found.cost = found.missing = 7;
  tested->pose_depth(scene.in(*tested), *none, {&empty, 1}, {}, {&found, 1});
  expect_agreement(found, PoseDepth{});
}

TEST_P(PoseDepthPaths, PosesNowhereSeeNothing) {
  std::mt19937 rng = test::test_rng();
  const test::DepthScene scene = test::make_depth_scene(rng);
  test::DepthCase c = test::depth_case(rng, scene, {}, 1, 70);
  c.problems.clear();
  for (const Pose& nowhere : test::poses_nowhere(rng)) c.problems.push_back({nowhere, 0, 70, 0});
  for (const PoseDepth& found : sums(*tested, scene, c, {})) expect_agreement(found, PoseDepth{});
}

// A point on the other side of a pixel's border reads another depth, so what lies exactly on it is
// decided where all arithmetic is exact.
TEST_P(PoseDepthPaths, TheBordersOfPixels) {
  const std::vector<float> values(17 * 9, 1.0f);
  test::DepthScene scene{{values}, {{values, 17, 9, {64, 64, 8, 4}}}};
  test::DepthCase c;
  for (const float x : {-9.0f, -8.75f, -8.5f, -8.25f, 0.5f, 8.25f, 8.5f, 9.0f, 1e6f})
    for (const float y : {-4.75f, -4.5f, 0.0f, 4.25f, 4.5f, 4.75f}) {
      c.problems.push_back({test::ahead, std::uint32_t(c.points.size()), 1, 0});
      c.points.push_back({x / 64, y / 64, 0, -std::copysign(0.6f, x), 0, -0.8f});
    }
  expect_same(sums(*tested, scene, c, {}), sums(*reference, scene, c, {}));
}

TEST_P(PoseDepthPaths, BrokenProblemsAreOurBugs) {
  std::mt19937 rng = test::test_rng();
  const test::DepthScene scene = test::make_depth_scene(rng);
  const std::vector<DepthHandle> views = scene.in(*tested);
  const SurfacePointsHandle points = tested->make_surface_points({3, {0, 0, 0, 0, 0, -1}});
  std::vector<PoseDepth> out(1);
  const auto compare = [&](PoseProblem problem, const PoseDepthOptions& options = {}) {
    tested->pose_depth(views, *points, {&problem, 1}, options, out);
  };
  const Pose pose = test::random_pose(rng, 0.3f);
  compare({pose, 0, 3, 0});
  EXPECT_THROW(compare({pose, 1, 3, 0}), LogicError) << "points beyond the list";
  EXPECT_THROW(compare({pose, 0, 3, 3}), LogicError) << "a view that is not there";
  EXPECT_THROW(compare({pose, 0, 3, 0}, {.noise_floor_m = 0}), LogicError);
  out.resize(2);
  EXPECT_THROW(compare({pose, 0, 3, 0}), LogicError) << "a result too many";
  const float depth = 1;
  EXPECT_THROW(tested->make_depth({{&depth, 1}, 1, 2, {}}), LogicError);
}

// On the narrow device the depth image does not fit; it is refused as an image of the user.
TEST_P(PoseDepthPaths, RefusesAnImageTooLargeToBind) {
  if (GetParam() != test::Path::vulkan_bands) GTEST_SKIP() << "takes any image of tests";
  const std::vector<float> values(test::test_band_bytes / sizeof(float) + 1, 1.0f);
  EXPECT_THROW(tested->make_depth({values, static_cast<int>(values.size()), 1, {}}), InputError);
}

TEST_P(PoseDepthPaths, WhatAnotherBackendMadeIsOurBug) {
  if (GetParam() == test::Path::cpu) GTEST_SKIP() << "the CPU's two paths share their memory";
  const float depth = 1;
  const DepthView view{{&depth, 1}, 1, 1, {1, 1, 0, 0}};
  const SurfacePointsHandle own = tested->make_surface_points({}),
                            other = reference->make_surface_points({});
  const DepthHandle other_view = reference->make_depth(view);
  EXPECT_THROW(tested->pose_depth({}, *other, {}, {}, {}), LogicError);
  EXPECT_THROW(tested->pose_depth({&other_view, 1}, *own, {}, {}, {}), LogicError);
}

INSTANTIATE_TEST_SUITE_P(Paths, PoseDepthPaths, test::all_paths, test::param_name);

}  // namespace
}  // namespace edgescout
