// All methods on rendered images of known poses, and the inputs that they refuse.
#include "host/baselines/baseline.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>

#include "host/baselines/candidate_scores.h"
#include "host/core/pose_error.h"
#include "host/register/occluders.h"
#include "kernels/error.h"
#include "tests/active/rendered_scene.h"
#include "tests/test_random.h"

namespace edgescout {
namespace {

using namespace test;

// Three views of one part, and starts around the truth.
struct Rendered {
  std::unique_ptr<Backend> backend = make_cpu_backend(2);
  RenderedScene scene{{"bearing_block"}, 1, 3};
  std::vector<ObjectView> views = scene.views(*backend);
  Se3 truth = scene.scene.placed[0].world_from_object;

  // The first `count` views.
  Scene first(std::size_t count) const {
    return {scene.models, std::span(views).first(count), *backend};
  }
  Scene all() const { return first(views.size()); }
  Scene with(const ObjectView& view) const { return {scene.models, {&view, 1}, *backend}; }

  std::vector<ObjectPose> starts(int count, double distance_m, double angle_rad,
                                 Random random) const {
    std::vector<ObjectPose> list;
    for (int i = 0; i < count; ++i)
      list.push_back({0, scene.candidate(0, distance_m, angle_rad, random).world_from_object});
    return list;
  }
};
const Rendered& rendered() {
  static const Rendered scene;
  return scene;
}

struct Accuracy {
  Method method;
  double one_view_px;                     // median of the largest displacement of a vertex
  double three_views_m, three_views_rad;  // of the worst
};
void PrintTo(const Accuracy& accuracy, std::ostream* out) { *out << to_string(accuracy.method); }

class Baseline : public ::testing::TestWithParam<Accuracy> {
 protected:
  // The first views, from ten starts.
  std::vector<PoseEstimate> results(std::size_t views, double distance_m, double angle_rad) const {
    const Rendered& r = rendered();
    const std::vector<ObjectPose> starts = r.starts(10, distance_m, angle_rad, test_random());
    return register_with(GetParam().method, r.first(views), starts);
  }
};
INSTANTIATE_TEST_SUITE_P(Methods, Baseline,
                         ::testing::Values(Accuracy{Method::D2co, 3, 2e-4, 6e-3},
                                           Accuracy{Method::DcIcp, 2, 2e-4, 6e-3},
                                           Accuracy{Method::LmIcp, 1.3, 2e-4, 6e-3},
                                           Accuracy{Method::CIcp, 1, 1e-4, 3e-3},
                                           Accuracy{Method::Direct, 1.5, 2e-4, 6e-3}),
                         [](const auto& named) {
                           std::string name = to_string(named.param.method);
                           std::erase(name, '-');
                           return name;
                         });

// One view determines depth and tilt badly, so the error is measured in the image. The starts are
// about 4 px off.
TEST_P(Baseline, RecoversAPartInOneView) {
  const Rendered& r = rendered();
  const Se3& camera_from_world = r.views[0].camera_from_world;
  const auto off_px = [&](const Se3& pose) {
    return mspd_px(camera_from_world * pose, camera_from_world * r.truth, r.scene.parts[0],
                   r.scene.camera());
  };
  std::vector<double> off;
  for (const PoseEstimate& found : results(1, 0.001, 0.02))
    off.push_back(off_px(found.world_from_object));
  std::ranges::sort(off);
  EXPECT_LT(off[5], GetParam().one_view_px);
}

TEST_P(Baseline, RecoversAPartInThreeViews) {
  for (const PoseEstimate& found : results(3, 0.003, 0.05)) {
    EXPECT_LT(distance_between_m(found.world_from_object, rendered().truth),
              GetParam().three_views_m);
    EXPECT_LT(angle_between_rad(found.world_from_object, rendered().truth),
              GetParam().three_views_rad);
    EXPECT_GT(found.points, 600);
    EXPECT_TRUE(found.covariance.allFinite());
  }
}

TEST_P(Baseline, TakesNoMoreIterationsThanAllowed) {
  const Rendered& r = rendered();
  BaselineOptions options;
  options.outer_iterations = options.inner_iterations = 3;
  options.pyramid_levels = 1;
  const std::vector<ObjectPose> starts = r.starts(1, 0.005, 0.1, test_random());
  const PoseEstimate found = register_with(GetParam().method, r.all(), starts, options)[0];
  EXPECT_EQ(found.iterations, 3);
  EXPECT_EQ(found.convergence, Convergence::IterationLimit);
}

// Near the optimum a method stops by itself, and a larger smallest step stops it sooner.
TEST_P(Baseline, EndsByASmallStep) {
  const Rendered& r = rendered();
  const std::vector<ObjectPose> starts = r.starts(5, 0.0005, 0.01, test_random());
  const auto results_with = [&](double coarser) {
    BaselineOptions options;
    options.inner_iterations = options.outer_iterations = 1000;
    options.min_step_m *= coarser;
    options.min_step_rad *= coarser;
    return register_with(GetParam().method, r.all(), starts, options);
  };
  int fine = 0, coarse = 0;
  for (const PoseEstimate& found : results_with(1)) {
    EXPECT_EQ(found.convergence, Convergence::Converged) << found.iterations;
    fine += found.iterations;
  }
  for (const PoseEstimate& found : results_with(1000)) coarse += found.iterations;
  EXPECT_LT(coarse, fine);
}

// `inner_iterations` ends the solve of every method, of one association or of the whole.
TEST_P(Baseline, SolvesWithTheLimitThatAllShare) {
  const Rendered& r = rendered();
  const std::vector<ObjectPose> start = r.starts(1, 0.003, 0.05, test_random());
  const auto moved_m = [&](int inner) {
    BaselineOptions options;
    options.outer_iterations = 1;
    options.inner_iterations = inner;
    options.pyramid_levels = 1;
    const PoseEstimate found = register_with(GetParam().method, r.all(), start, options)[0];
    return distance_between_m(found.world_from_object, start[0].world_from_object);
  };
  EXPECT_GT(moved_m(1), 0);
  EXPECT_NE(moved_m(1), moved_m(2)) << "one more step of the same solve";
}

TEST_P(Baseline, LeavesWhatLiesBehindTheCameraWhereItIs) {
  const Rendered& r = rendered();
  const ObjectPose behind{
      0, inverse(r.views[0].camera_from_world) * Se3{Eigen::Quaterniond::Identity(), {0, 0, -0.5}}};
  const PoseEstimate found = register_with(GetParam().method, r.first(1), {&behind, 1})[0];
  EXPECT_EQ(found.convergence, Convergence::NoPoints);
  EXPECT_EQ(found.points, 0);
  EXPECT_EQ(distance_between_m(found.world_from_object, behind.world_from_object), 0);
}

TEST_P(Baseline, RefusesOptionsOutOfRange) {
  const Rendered& r = rendered();
  const auto expect_refused = [&](const char* field, const auto& spoil) {
    BaselineOptions options;
    spoil(options);
    try {
      register_with(GetParam().method, r.all(), {}, options);
      ADD_FAILURE() << field;
    } catch (const InputError& error) {
      EXPECT_NE(std::string(error.what()).find(field), std::string::npos) << error.what();
    }
  };
  expect_refused("outer_iterations", [](BaselineOptions& o) { o.outer_iterations = 0; });
  expect_refused("inner_iterations", [](BaselineOptions& o) { o.inner_iterations = 1001; });
  expect_refused("min_step_m", [](BaselineOptions& o) { o.min_step_m = -1e-6; });
  expect_refused("min_step_rad", [](BaselineOptions& o) {
    o.min_step_rad = std::numeric_limits<double>::quiet_NaN();
  });
  expect_refused("loss_scale_px", [](BaselineOptions& o) { o.loss_scale_px = 0; });
  expect_refused("pyramid_levels", [](BaselineOptions& o) { o.pyramid_levels = 9; });
}

TEST(BaselineMethods, WantAViewAndTheModel) {
  const Rendered& r = rendered();
  const ObjectPose unknown{1, r.truth};
  EXPECT_THROW(register_with(Method::CIcp, r.first(0), {}), LogicError);
  EXPECT_THROW(register_with(Method::CIcp, r.all(), {&unknown, 1}), LogicError);
}

// A wall close to the camera hides the part.
TEST(BaselineMethods, LeaveOutWhatOccludersHide) {
  const Rendered& r = rendered();
  ObjectView view = r.views[0];
  const ObjectPose truth{0, r.truth};
  Occluders wall{view.camera, {}};
  wall.depth_m.assign(std::size_t(view.camera.width) * std::size_t(view.camera.height), 0.05f);
  view.occluders = std::make_shared<const Occluders>(wall);
  for (const Method method : all_methods())
    EXPECT_EQ(register_with(method, r.with(view), {&truth, 1})[0].convergence,
              Convergence::NoPoints)
        << to_string(method);
  EXPECT_EQ(fdcm_scores(r.with(view), {&truth, 1})[0], view.tensor->options.cap_px);
  EXPECT_EQ(line2d_scores(r.with(view), {&truth, 1})[0], 0);
}

TEST(BaselineMethods, WantWhatTheyRead) {
  const Rendered& r = rendered();
  ObjectView bare = r.views[0];
  bare.edges = nullptr;
  bare.image = nullptr;
  for (const Method method : {Method::DcIcp, Method::LmIcp, Method::CIcp, Method::Direct})
    EXPECT_THROW(prepare_method(method, r.with(bare)), LogicError);
}

TEST(BaselineMethods, AreKnownByName) {
  for (const Method method : all_methods()) EXPECT_EQ(method_from(to_string(method)), method);
  try {
    method_from("icp");
    ADD_FAILURE();
  } catch (const InputError& error) {
    EXPECT_STREQ(
        error.what(),
        "registration: method: found \"icp\", expected one of d2co, dc-icp, lm-icp, c-icp, direct");
  }
}

}  // namespace
}  // namespace edgescout
