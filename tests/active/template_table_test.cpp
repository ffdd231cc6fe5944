#include "host/active/template_table.h"

#include <gtest/gtest.h>

#include <map>
#include <set>

#include "host/model/viewpoints.h"
#include "tests/model/box.h"
#include "tests/register/scene.h"
#include "tests/test_random.h"

namespace edgescout::test {
namespace {

Eigen::Vector3d place(const TemplateTablePoint& p) {
  return {p.point.x_m, p.point.y_m, p.point.z_m};
}

TEST(TemplateTable, GivesEachPlaceOneId) {
  const auto backend = make_cpu_backend(2);
  const EdgeModel model = part_model("bearing_block");
  TemplateTableOptions options;
  options.frequency = 3;
  options.most_points = 200;
  const TemplateTable table = make_template_table(model, 0.4, *backend, options);
  ASSERT_EQ(table.points.size(), 92u);
  std::map<std::uint32_t, Eigen::Vector3d> places;
  std::size_t most = 0;
  double widest = 0;
  for (const std::vector<TemplateTablePoint>& points : table.points) {
    std::set<std::uint32_t> ids;
    for (const TemplateTablePoint& p : points) {
      EXPECT_LT(p.id, table.total);
      EXPECT_TRUE(ids.insert(p.id).second) << "twice from one viewpoint";
      const auto [known, is_new] = places.try_emplace(p.id, place(p));
      if (!is_new) widest = std::max(widest, (known->second - place(p)).cwiseAbs().maxCoeff());
    }
    most = std::max(most, points.size());
  }
  EXPECT_EQ(places.size(), table.total);
  EXPECT_LE(most, 200u);
  EXPECT_GT(most, 120u);  // no coarser than it takes
  EXPECT_LT(widest, 0.1 * model.mesh.diameter_m);
}

// Seen straight on, a face of a box shows its own four edges and hides those behind it.
TEST(TemplateTable, HasThePointsVisibleFromEachSide) {
  const auto backend = make_cpu_backend(2);
  const EdgeModel model = make_edge_model(box_mesh(0.06, 0.05, 0.04));
  const TemplateTable table = make_template_table(model, 0.5, *backend);
  Random random = test_random();
  constexpr int poses = 20;
  double mean_right = 0, mean_known = 0;
  for (int i = 0; i < poses; ++i) {
    const Se3 camera_from_object{random.rotation(), {0.01, -0.02, 0.5}};
    const Eigen::Vector3d eye = inverse(camera_from_object).translation_m;
    const std::vector<TemplateTablePoint>& seen = table.visible_from(camera_from_object);
    const std::vector<ModelPoint> exact =
        visible_edges(model, std::span(&camera_from_object, 1), *backend)[0];
    // The viewpoint is off by some degrees, in which the three edges of a face may come or go, of
    // nine or seven; nearly all points are common.
    const auto is_near = [](const TemplateTablePoint& p, const ModelPoint& e) {
      return (Eigen::Vector3d(e.x_m, e.y_m, e.z_m) - place(p)).norm() < 0.002;
    };
    const auto shows = [&](const TemplateTablePoint& p) {
      return std::ranges::any_of(exact, [&](const ModelPoint& e) { return is_near(p, e); });
    };
    const auto is_known = [&](const ModelPoint& e) {
      return std::ranges::any_of(seen, [&](const TemplateTablePoint& p) { return is_near(p, e); });
    };
    const double right = double(std::ranges::count_if(seen, shows)) / double(seen.size()),
                 known = double(std::ranges::count_if(exact, is_known)) / double(exact.size());
    EXPECT_GT(right, 0.6);
    EXPECT_GT(known, 0.6);
    mean_right += right / poses, mean_known += known / poses;
    // Oracle: no point of the far corner.
    const Eigen::Vector3d far_corner =
        -Eigen::Vector3d(0.03, 0.025, 0.02).cwiseProduct(eye.cwiseSign());
    if (eye.cwiseAbs().minCoeff() < 0.15) continue;  // nearly straight onto a face
    for (const TemplateTablePoint& p : seen) EXPECT_GT((place(p) - far_corner).norm(), 0.003);
  }
  EXPECT_GT(mean_right, 0.9);
  EXPECT_GT(mean_known, 0.9);
}

TEST(TemplateTable, TakesTheNearestViewpoint) {
  Random random = test_random();
  const auto backend = make_cpu_backend(2);
  const EdgeModel model = part_model("l_bracket");
  const TemplateTable table = make_template_table(model, 0.4, *backend, {2, 500});
  const std::vector<Eigen::Vector3d> directions = icosphere(2);
  for (int i = 0; i < 50; ++i) {
    const Se3 pose{random.rotation(), {0, 0, 0.6}};
    const Eigen::Vector3d direction = (inverse(pose).translation_m - model.center_m).normalized();
    double least = 9;
    std::size_t nearest = 0;
    for (std::size_t v = 0; v < directions.size(); ++v) {
      const double angle = std::acos(std::clamp(direction.dot(directions[v]), -1.0, 1.0));
      if (angle < least) least = angle, nearest = v;
    }
    EXPECT_EQ(&table.visible_from(pose), &table.points[nearest]);
  }
}

}  // namespace
}  // namespace edgescout::test
