#include "host/model/mesh_quality.h"

#include <gtest/gtest.h>

#include <random>

#include "host/io/mesh.h"
#include "host/render/parts.h"
#include "tests/io/collected_log.h"
#include "tests/model/box.h"
#include "tests/model/solids.h"

namespace edgescout::test {
namespace {

// Without the triangles of one end: (x, y) sides of 0.01 m, 0.1 m high.
EdgeModel open_box(double height_m) {
  const Mesh box = box_mesh(0.01, 0.01, height_m);
  std::vector<std::array<int, 3>> triangles = box.triangles;
  std::erase_if(triangles, [&](const auto& t) {
    return box.vertices_m[t[0]].z() > 0 && box.vertices_m[t[1]].z() > 0 &&
           box.vertices_m[t[2]].z() > 0;
  });
  return make_edge_model(make_mesh("open", box.vertices_m, triangles));
}

TEST(MeshQuality, MeasuresOpenBorders) {
  const MeshQuality quality = mesh_quality(open_box(0.1));
  EXPECT_NEAR(quality.drawn_m, 0.48, 1e-9);
  EXPECT_NEAR(quality.open_border_share, 0.04 / 0.48, 1e-9);
  EXPECT_EQ(quality.inconsistent_edges, 0u);
}

TEST(MeshQuality, WarnsOfMoreThanATenthOfOpenBorder) {
  EXPECT_EQ(mesh_warning(open_box(0.1)), "");  // 8.3 %
  const EdgeModel lower = open_box(0.05);      // 0.04 of 0.28 m
  EXPECT_NE(mesh_warning(lower).find("mesh open: 14 % of the drawn edge length is open border"),
            std::string::npos)
      << mesh_warning(lower);
  CollectedLog log;
  warn_of_mesh(lower);
  warn_of_mesh(open_box(0.1));
  ASSERT_EQ(log.messages.size(), 1u);
  EXPECT_EQ(log.messages[0], std::pair(LogLevel::Warning, mesh_warning(lower)));
}

TEST(MeshQuality, WarnsOfARoughSurface) {
  const Mesh ball = icosphere(0.05, 4);
  std::mt19937 random(1);
  std::uniform_real_distribution<double> height(0.97, 1.03);
  std::vector<Eigen::Vector3d> rough;
  for (const Eigen::Vector3d& x : ball.vertices_m) rough.push_back(height(random) * x);
  const EdgeModel model = model_of(make_mesh("rough", rough, ball.triangles), 0.02);
  EXPECT_GT(mesh_quality(model).short_edge_share, 0.5);
  EXPECT_NE(mesh_warning(model).find("rough"), std::string::npos) << mesh_warning(model);
}

TEST(MeshQuality, TakesAFinelyDividedRimForOneEdge) {
  const EdgeModel bar = model_of(make_bar(0.02, 0.1), 0.03);  // longer than the chords of the rims
  for (const EdgeModel::Segment& piece : bar.creases)
    ASSERT_LT((piece.to_m - piece.from_m).norm(), bar.raster_step_m);
  EXPECT_EQ(mesh_quality(bar).short_edge_share, 0);
}

TEST(MeshQuality, CountsEdgesWhereWindingsDisagree) {
  Mesh box = box_mesh(0.1, 0.1, 0.1);
  std::swap(box.triangles[0][0], box.triangles[0][1]);
  EXPECT_EQ(mesh_quality(make_edge_model(box)).inconsistent_edges, 3u);
}

}  // namespace
}  // namespace edgescout::test
