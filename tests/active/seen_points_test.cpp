#include "host/active/seen_points.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "tests/active/plan.h"
#include "tests/register/linear_tensor.h"

namespace edgescout::test {
namespace {

TEST(SeenPoints, CountsWhatProjectsIntoTheImages) {
  Plan t(2);
  const Se3& world_from_object = t.candidates[0].world_from_object;
  const TemplateTable& table = t.tables[0];
  const SeenPoints none = points_seen_in({}, table, world_from_object, 4);
  EXPECT_EQ(none.count, 0u);
  const std::vector<ObjectView> two{looked_from(t.views[0]), looked_from(t.views[4])};
  const SeenPoints seen = points_seen_in(two, table, world_from_object,
                                         4);  // no edge index: inside the image is enough
  std::vector<char> expected(table.total, 0);
  for (const ObjectView& view : two)
    for (const TemplateTablePoint& p :
         table.visible_from(view.camera_from_world * world_from_object)) {
      const Eigen::Vector2d at =
          project(view.camera, view.camera_from_world * world_from_object *
                                   Eigen::Vector3d(p.point.x_m, p.point.y_m, p.point.z_m));
      if (at.x() > -0.5 && at.y() > -0.5 && at.x() < 479.5 && at.y() < 359.5) expected[p.id] = 1;
    }
  EXPECT_EQ(seen.by_id, expected);
  EXPECT_EQ(seen.count, std::uint32_t(std::ranges::count(expected, char(1))));
  EXPECT_GT(seen.count, 50u);
  // In a third view these points are seen and the others unseen.
  const Se3 third = t.views[7] * world_from_object;
  for (const ParticlePoint& point : points_in_image(table, third, test_camera(), none))
    EXPECT_EQ(point.unseen, 1u);
  std::size_t unseen = 0, new_ids = 0;
  for (const ParticlePoint& point : points_in_image(table, third, test_camera(), seen))
    unseen += point.unseen;
  for (const TemplateTablePoint& p : table.visible_from(third)) new_ids += !expected[p.id];
  EXPECT_EQ(unseen, new_ids);
  EXPECT_GT(unseen, 0u);
}

// An image without edges has shown no point; one with edges along the template has.
TEST(SeenPoints, NeedsAnEdgeOfTheImage) {
  Plan t(1);
  const Se3& world_from_object = t.candidates[0].world_from_object;
  ObjectView view = looked_from(t.views[0]);
  const Se3 camera_from_object = view.camera_from_world * world_from_object;
  std::vector<EdgePoint> edges;
  view.edges = std::make_shared<EdgeIndex>(edges, 480, 360);
  EXPECT_EQ(points_seen_in(std::span(&view, 1), t.tables[0], world_from_object, 4).count, 0u);
  const std::uint32_t all =
      points_seen_in(std::span(&view, 1), t.tables[0], world_from_object, 0).count;
  const double middle = project(test_camera(), camera_from_object * t.models[0].center_m).x();
  for (const TemplateTablePoint& p : t.tables[0].visible_from(camera_from_object)) {
    const Landing at = land({600, 600, 239.5, 179.5}, camera_from_object, p.point);
    if (at.u < middle) edges.push_back({float(at.u) + 1, float(at.v), float(at.theta), 1});
  }
  view.edges = std::make_shared<EdgeIndex>(edges, 480, 360);
  const std::uint32_t matched =
      points_seen_in(std::span(&view, 1), t.tables[0], world_from_object, 4).count;
  EXPECT_GE(matched, edges.size());
  EXPECT_LT(matched, all);
  for (EdgePoint& edge : edges)
    edge.theta_rad = float(std::fmod(edge.theta_rad + 1.5, std::numbers::pi));
  view.edges = std::make_shared<EdgeIndex>(edges, 480, 360);
  EXPECT_LT(points_seen_in(std::span(&view, 1), t.tables[0], world_from_object, 4).count,
            matched / 2);
}

}  // namespace
}  // namespace edgescout::test
