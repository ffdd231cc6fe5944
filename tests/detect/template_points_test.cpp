// Points that are looked up, against those that a depth map of the same pose shows.
#include "host/register/template_points.h"

#include <gtest/gtest.h>

#include "host/core/thinned.h"
#include "host/register/occluders.h"
#include "host/register/visible_in_views.h"
#include "tests/detect/part_image.h"
#include "tests/test_random.h"

namespace edgescout::test {
namespace {

Eigen::Vector3d place(const ModelPoint& p) { return {p.x_m, p.y_m, p.z_m}; }
Eigen::Vector3d along(const ModelPoint& p) { return {p.tx, p.ty, p.tz}; }

// The fraction of `points` that have one of `others` within `near_m` in the same direction.
double fraction_near(const std::vector<ModelPoint>& points, const std::vector<ModelPoint>& others,
                     double near_m) {
  const auto has_neighbour = [&](const ModelPoint& a) {
    return std::ranges::any_of(others, [&](const ModelPoint& b) {
      return (place(a) - place(b)).norm() < near_m && std::abs(along(a).dot(along(b))) > 0.9;
    });
  };
  return double(std::ranges::count_if(points, has_neighbour)) / double(points.size());
}

struct PosesInViews {
  std::unique_ptr<Backend> backend = make_cpu_backend(2);
  TemplateSet set;
  std::vector<ObjectView> views{2};
  std::vector<ObjectPose> poses;

  PosesInViews(const char* part, Random& random)
      : set(part_templates(part, 5, 0.28, 0.34, *backend)) {
    for (ObjectView& view : views) {
      view.camera = small_camera();
      view.camera_from_world =
          camera_looking_at(0.31 * random.direction(), Eigen::Vector3d::Zero());
    }
    for (int i = 0; i < 12; ++i)
      poses.push_back({0, {random.rotation(), 0.01 * random.direction()}});
  }
  Grid<std::vector<ModelPoint>> points(int most) const {
    const PointsInViews<ModelPoint> found =
        template_points(set, views, poses, {.edges = most}, *backend).visible.edges;
    Grid<std::vector<ModelPoint>> edges(found.ranges.rows(), found.ranges.columns());
    std::ranges::transform(found.ranges.values(), edges.values().begin(),
                           [&](const PointRange& range) {
                             const auto first = found.points.begin() + range.first;
                             return std::vector<ModelPoint>(first, first + range.count);
                           });
    return edges;
  }
};

// One of the parts looks the same after a half turn; its set has viewpoints on one side only.
TEST(TemplatePoints, AreThoseThatShow) {
  Random random = test_random();
  bool symmetric = false;
  for (const char* part : {"l_bracket", "bearing_block", "u_channel"}) {
    const PosesInViews t(part, random);
    symmetric |= t.set.symmetries.discrete.size() > 1;
    const Grid<VisibleInView> visible =
        visible_in_views({{&t.set.model, 1}, t.views, *t.backend}, t.poses);
    const Grid<std::vector<ModelPoint>> looked_up = t.points(0);
    const std::span<const VisibleInView> shown = visible.values();
    const std::span<const std::vector<ModelPoint>> all = looked_up.values();
    ASSERT_EQ(all.size(), shown.size());
    const double near_m = 0.03 * t.set.model.mesh.diameter_m;
    double right = 0, found = 0;
    for (std::size_t i = 0; i < all.size(); ++i) {
      right += fraction_near(all[i], shown[i].points, near_m) / double(all.size());
      found += fraction_near(shown[i].points, all[i], near_m) / double(all.size());
    }
    EXPECT_GT(right, 0.93) << part;
    EXPECT_GT(found, 0.93) << part;
  }
  EXPECT_TRUE(symmetric);
}

TEST(TemplatePoints, AreThinnedEvenlyWithoutHiddenOnes) {
  Random random = test_random();
  PosesInViews t("l_bracket", random);
  const Grid<std::vector<ModelPoint>> all = t.points(0), some = t.points(50);
  const ObjectPose cover{
      0, inverse(t.views[1].camera_from_world) * Se3{random.rotation(), {0, 0, 0.2}}};
  t.views[1].occluders = make_occluders({&t.set.model, 1}, {&cover, 1}, t.views[1], *t.backend);
  const Grid<std::vector<ModelPoint>> left = t.points(50);
  std::size_t hidden = 0;
  for (std::size_t i = 0; i < all.values().size(); ++i) {
    std::vector<ModelPoint> expected = thinned(all.values()[i], 50);
    ASSERT_EQ(some.values()[i].size(), expected.size());
    for (std::size_t p = 0; p < expected.size(); ++p)
      EXPECT_EQ(place(some.values()[i][p]), place(expected[p]));
    if (i % 2 == 1)
      hidden += std::erase_if(expected, [&](const ModelPoint& p) {
        return t.views[1].occluders->hide(
            t.views[1].camera_from_world * t.poses[i / 2].world_from_object * place(p),
            occlusion_tolerance_m(t.set.model));
      });
    ASSERT_EQ(left.values()[i].size(), expected.size());
    for (std::size_t p = 0; p < expected.size(); ++p)
      EXPECT_EQ(place(left.values()[i][p]), place(expected[p]));
  }
  EXPECT_GT(hidden, 50u);
}

TEST(TemplatePoints, AreCountedOutsideTheImage) {
  Random random = test_random();
  PosesInViews t("l_bracket", random);
  for (ObjectPose& pose : t.poses) pose.world_from_object.translation_m += 0.1 * random.direction();
  const auto found = [&](bool in_image) {
    return template_points(t.set, t.views, t.poses, {.edges = 50, .in_image = in_image},
                           *t.backend);
  };
  const TemplatePoints all = found(false), inside = found(true);
  std::size_t total = 0;
  for (std::size_t p = 0; p < t.poses.size(); ++p)
    for (std::size_t v = 0; v < t.views.size(); ++v) {
      const PointRange& range = all.visible.edges.ranges(p, v);
      const Se3 camera_from_object = t.views[v].camera_from_world * t.poses[p].world_from_object;
      std::size_t outside = 0;
      for (const ModelPoint& point :
           std::span(all.visible.edges.points).subspan(range.first, range.count)) {
        const Camera& camera = t.views[v].camera;
        const Eigen::Vector3d at = camera_from_object * place(point);
        const Eigen::Vector2d px = project(camera, at);
        outside += !(at.z() > 0 && px.minCoeff() >= 0 && px.x() <= camera.width - 1 &&
                     px.y() <= camera.height - 1);
      }
      EXPECT_EQ(all.outside(p, v), outside);
      EXPECT_EQ(inside.outside(p, v), 0u);
      total += outside;
    }
  EXPECT_GT(total, 50u);
}

TEST(TemplatePoints, AreSharedWhereNothingHidesThem) {
  Random random = test_random();
  PosesInViews t("l_bracket", random);
  const std::vector<ObjectPose> apart = t.poses;
  for (int copies = 0; copies < 3; ++copies)
    t.poses.insert(t.poses.end(), apart.begin(), apart.end());
  const auto list_size = [&] {
    return template_points(t.set, t.views, t.poses, {.edges = 50}, *t.backend)
        .visible.edges.points.size();
  };
  EXPECT_LE(list_size(), 50 * 2 * apart.size());
  const ObjectPose far_away{
      0, inverse(t.views[1].camera_from_world) * Se3{random.rotation(), {0, 0, 5}}};
  t.views[1].occluders = make_occluders({&t.set.model, 1}, {&far_away, 1}, t.views[1], *t.backend);
  EXPECT_GE(list_size(), 50 * t.poses.size());
}

}  // namespace
}  // namespace edgescout::test
