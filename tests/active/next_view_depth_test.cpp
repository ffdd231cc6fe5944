// The information that is expected of a view where surfaces were measured.
#include <gtest/gtest.h>

#include <cmath>

#include "host/register/measured_depth.h"
#include "tests/active/plan.h"

namespace edgescout::test {
namespace {

// The real view has measured a plane: the points x with n x = d, in the world.
ObjectView with_plane(ObjectView view, const Eigen::Vector3d& normal, double d_m) {
  const Se3 world_from_camera = inverse(view.camera_from_world);
  MeasuredDepth depth{{view.camera.width, view.camera.height, {}}, {}};
  for (int y = 0; y < view.camera.height; ++y)
    for (int x = 0; x < view.camera.width; ++x) {
      const Eigen::Vector3d ray = world_from_camera.rotation * ray_through(view.camera, {x, y});
      const double z_m = (d_m - normal.dot(world_from_camera.translation_m)) / normal.dot(ray);
      depth.image.z_m.push_back(z_m > 0 ? float(z_m) : DEPTH_MISSING);
    }
  view.depth = std::make_shared<const MeasuredDepth>(std::move(depth));
  return view;
}

std::vector<ViewInformation> information(const Plan& t, Backend& backend) {
  NextViewProblem problem = t.problem(backend);
  problem.workspace = workspace_of({}, t.views, test_camera());
  return view_information(problem, t.options);
}

TEST(ViewInformation, IsLessWhereAMeasuredSurfaceHidesTheParts) {
  Plan t;
  t.closed[0] = 0;
  const std::vector<ViewInformation> open = information(t, *t.backend);
  t.real[0] = with_plane(t.real[0], {0, 0, 1}, -0.5);  // far below the parts
  const std::vector<ViewInformation> above = information(t, *t.backend);
  t.real[0] = with_plane(t.real[0], {0, 0, 1}, 0.15);  // between all cameras and the parts
  const std::vector<ViewInformation> below = information(t, *t.backend);
  EXPECT_GT(open[0].information, 0.1);
  EXPECT_EQ(below[0].information, 0);  // the view that measured the plane sees nothing behind it
  double most = 0;
  for (std::size_t v = 0; v < t.views.size(); ++v) {
    EXPECT_EQ(above[v].information, open[v].information) << v;
    most = std::max(most, below[v].information);
  }
  EXPECT_GT(most, 0.1);  // others look past what the first image shows of it
}

TEST(ViewInformation, BehindAMeasuredSurfaceIsTheSameOnEveryDevice) {
  Plan t;
  t.options.exploration_bonus_nats = 1;
  t.real[0] = with_plane(t.real[0], {0, 0, 1}, 0.04);  // through the parts
  const std::vector<ViewInformation> fast = information(t, *t.backend),
                                     reference = information(t, *make_reference_backend());
  for (std::size_t v = 1; v < fast.size(); ++v) {
    EXPECT_NEAR(fast[v].information, reference[v].information, 1e-2 * reference[v].information);
    EXPECT_NEAR(fast[v].discovery, reference[v].discovery, 1e-3);
  }
}

// The bonus of a view follows the unmeasured space that it sees.
TEST(ViewInformation, IsDiscoveryWhereNothingWasMeasured) {
  Plan t;
  t.options.exploration_bonus_nats = 1;
  const double by_angle = information(t, *t.backend)[1].discovery;
  // Nothing is unmeasured: the plane lies below the workspace, and the image shows all of it.
  t.real[0] = with_plane(t.real[0], {0, 0, 1}, -0.6);
  const std::vector<ViewInformation> all_measured = information(t, *t.backend);
  for (std::size_t v = 1; v < t.views.size(); ++v) EXPECT_LT(all_measured[v].discovery, 0.2);
  EXPECT_GT(by_angle, 0.2);
  // A wall before the workspace hides it all from the first view, and little from the far side.
  const Eigen::Vector3d to_camera = inverse(t.views[0]).translation_m.normalized();
  t.real[0] = with_plane(t.real[0], to_camera, 0.15);
  const std::vector<ViewInformation> behind_wall = information(t, *t.backend);
  double least = 1, most = 0;
  for (std::size_t v = 1; v < t.views.size(); ++v) {
    least = std::min(least, behind_wall[v].discovery),
    most = std::max(most, behind_wall[v].discovery);
  }
  EXPECT_GT(most, 0.8);
  EXPECT_LT(least, most);
}

}  // namespace
}  // namespace edgescout::test
