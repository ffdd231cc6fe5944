#include "host/detect/template_projection.h"

#include <gtest/gtest.h>

#include <numbers>

#include "host/core/thinned.h"
#include "host/detect/coarse_scan.h"
#include "kernels/pose_geometry.h"
#include "tests/detect/part_image.h"
#include "tests/test_random.h"

namespace edgescout::test {
namespace {

constexpr int BINS = 60;

// Against kernels/pose_geometry.h in double, one point at a time.
TEST(ThinnedView, ProjectsAndRoundsEveryPoint) {
  const auto backend = make_cpu_backend(1);
  const TemplateSet set = part_templates("bearing_block", 2, 0.3, 0.3, *backend);
  Random random = test_random();
  const Camera camera = small_camera();
  const Intrinsics k = intrinsics_of(camera);
  int apart = 0, all = 0;
  for (int i = 0; i < 200; ++i) {
    const TemplateView& view = set.views[std::size_t(random.below(int(set.views.size())))];
    const int most = 1 + random.below(int(TEMPLATE_SCORE_MAX_POINTS));
    const ThinnedView thinned(view, most);
    ASSERT_EQ(thinned.count(), std::min<int>(most, int(view.points.size())));
    const Pose pose =
        to_pose(place_template(set, view, random.uniform(0, 6), random.uniform(0.2, 0.6),
                               {random.uniform(0, 320), random.uniform(0, 240)}, camera));
    std::vector<TemplatePoint> found(std::size_t(thinned.count()));
    ASSERT_TRUE(thinned.project(pose, {k, BINS, 0.01f}, found.data()));
    for (std::size_t p = 0; p < found.size(); ++p) {
      const ModelPoint& point = view.points[p * view.points.size() / found.size()];
      const ProjectedEdge<double> edge = project_edge(pose_point<double>(pose, point), k);
      const double bin = orientation(edge.dx, edge.dy) * BINS / std::numbers::pi;
      // Half a pixel, half a bin, and the error of single precision at the border between two.
      EXPECT_NEAR(found[p].dx_px, edge.u, 0.501);
      EXPECT_NEAR(found[p].dy_px, edge.v, 0.501);
      EXPECT_LT(std::abs(std::remainder(found[p].bin - bin, double(BINS))), 0.501);
      EXPECT_LT(found[p].bin, BINS);
      ++all;
      apart += std::lround(edge.u) != found[p].dx_px || std::lround(edge.v) != found[p].dy_px ||
               std::lround(bin) % BINS != found[p].bin;
    }
  }
  EXPECT_LT(apart, all / 500);
}

TEST(ThinnedView, ReportsPointsThatAreTooNear) {
  const auto backend = make_cpu_backend(1);
  const TemplateSet set = part_templates("l_bracket", 1, 0.3, 0.3, *backend);
  const ThinnedView thinned(set.views[0], 50);
  std::vector<TemplatePoint> found(std::size_t(thinned.count()));
  const Se3 far{set.views[0].camera_from_object, {0, 0, 1}},
      behind{set.views[0].camera_from_object, {0, 0, -1}};
  EXPECT_TRUE(thinned.project(to_pose(far), {{300, 300, 0, 0}, BINS, 0.1f}, found.data()));
  EXPECT_FALSE(thinned.project(to_pose(far), {{300, 300, 0, 0}, BINS, 2.0f}, found.data()));
  EXPECT_FALSE(thinned.project(to_pose(behind), {{300, 300, 0, 0}, BINS, 0.1f}, found.data()));
}

// A point far outside stays outside after the place of a job is added; it does not wrap around.
TEST(ThinnedView, ClampsPointsFarOutside) {
  TemplateView view;
  view.points = {{100, -100, 0, 1, 0, 0}};
  TemplatePoint found;
  ASSERT_TRUE(
      ThinnedView(view, 1).project(to_pose(Se3{Eigen::Quaterniond::Identity(), {0, 0, 0.1}}),
                                   {{1000, 1000, 0, 0}, BINS, 0.01f}, &found));
  EXPECT_EQ(found.dx_px, 16000);
  EXPECT_EQ(found.dy_px, -16000);
}

}  // namespace
}  // namespace edgescout::test
