// Meshes with defects show the edges of the mesh without.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "host/io/mesh.h"
#include "host/model/mesh_quality.h"
#include "host/render/parts.h"
#include "tests/examples.h"
#include "tests/model/mesh_defects.h"

namespace edgescout::test {
namespace {

using Eigen::Vector3d;

EdgeModel model_of(const Triangles& mesh) {
  return make_edge_model(make_mesh("spoilt", mesh.vertices, mesh.triangles));
}

double distance_to(const std::vector<EdgeModel::Segment>& edges, const Vector3d& x) {
  double nearest = std::numeric_limits<double>::infinity();
  for (const EdgeModel::Segment& edge : edges) {
    const Vector3d along = edge.to_m - edge.from_m;
    const double s = std::clamp((x - edge.from_m).dot(along) / along.squaredNorm(), 0.0, 1.0);
    nearest = std::min(nearest, (x - edge.from_m - s * along).norm());
  }
  return nearest;
}

double length_of(const EdgeModel& model) { return mesh_quality(model).drawn_m; }

// Both draw the same lines, within a share of the diameter.
void expect_same_edges(const EdgeModel& expected, const EdgeModel& found, double share) {
  const double tolerance_m = share * expected.mesh.diameter_m;
  EXPECT_NEAR(length_of(found), length_of(expected), 0.01 * length_of(expected));
  for (const auto& [of, in] : {std::pair{&expected, &found}, std::pair{&found, &expected}})
    for (const RasterPoint& p : of->crease_points)
      ASSERT_LE(distance_to(in->creases, p.point_m), tolerance_m) << p.point_m.transpose();
  EXPECT_EQ(mesh_warning(found), "");
}

class SpoiltPart : public testing::TestWithParam<std::string> {
 protected:
  const Mesh mesh = make_part(GetParam()).mesh;
  const Triangles clean = triangles_of(mesh);
  const EdgeModel expected = make_edge_model(mesh);
};

INSTANTIATE_TEST_SUITE_P(Parts, SpoiltPart, testing::ValuesIn(part_names()),
                         [](const auto& part) { return part.param; });

TEST_P(SpoiltPart, KeepsACleanMeshAsItIs) {
  const Mesh again = make_mesh("again", mesh.vertices_m, mesh.triangles);
  EXPECT_EQ(again.vertices_m, mesh.vertices_m);
  EXPECT_EQ(again.triangles, mesh.triangles);
  EXPECT_EQ(mesh_warning(expected), "");
}

TEST_P(SpoiltPart, JoinsLooseTriangles) {
  for (const double share : {0.0, 1e-7, 1e-6, 4e-6, 1e-5})
    for (const unsigned seed : {1u, 2u}) {
      SCOPED_TRACE(testing::Message() << "jitter " << share << ", seed " << seed);
      const double jitter_m = share * mesh.diameter_m;
      expect_same_edges(expected, model_of(jittered(loose(clean), jitter_m, seed)), 1e-4);
    }
}

TEST_P(SpoiltPart, MakesWindingConsistent) {
  for (const double probability : {0.002, 0.1, 0.5, 0.9, 1.0})
    for (const unsigned seed : {1u, 2u}) {
      SCOPED_TRACE(testing::Message() << probability << ", seed " << seed);
      const EdgeModel found = model_of(flipped(clean, probability, seed));
      expect_same_edges(expected, found, 1e-6);
      EXPECT_EQ(found.corner_normals.size(), expected.corner_normals.size());
      for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
        EXPECT_GT(found.mesh.face_normals[t].dot(mesh.face_normals[t]), 0.999999) << t;
    }
}

TEST_P(SpoiltPart, JoinsTJunctions) {
  for (const double probability : {0.05, 0.5, 1.0})
    for (const unsigned seed : {1u, 2u}) {
      SCOPED_TRACE(testing::Message() << probability << ", seed " << seed);
      expect_same_edges(expected, model_of(with_t_junctions(clean, probability, seed)), 1e-5);
    }
}

TEST_P(SpoiltPart, DropsDoubledTriangles) {
  expect_same_edges(expected, model_of(doubled(clean)), 1e-6);
  const double jitter_m = 1e-6 * mesh.diameter_m;
  expect_same_edges(expected, model_of(jittered(loose(doubled(clean)), jitter_m, 3)), 1e-4);
}

TEST_P(SpoiltPart, DropsSliversWithoutHoles) {
  for (const double share : {0.0, 1e-8, 1e-6, 9e-6}) {
    SCOPED_TRACE(share);
    const EdgeModel found = model_of(with_slivers(clean, share * mesh.diameter_m));
    expect_same_edges(expected, found, 1e-4);
    EXPECT_EQ(mesh_quality(found).open_border_share, 0);
  }
}

TEST_P(SpoiltPart, MendsAllDefectsAtOnce) {
  const double jitter_m = 1e-6 * mesh.diameter_m;
  for (const unsigned seed : {1u, 2u, 3u}) {
    SCOPED_TRACE(seed);
    const Triangles spoilt =
        flipped(with_t_junctions(with_slivers(clean, 0), 0.3, seed), 0.4, seed);
    expect_same_edges(expected, model_of(jittered(loose(spoilt), jitter_m, seed)), 1e-4);
  }
}

TEST(MeshRepair, ClosesSeamsThatFacesDivideInTheirOwnWay) {
  for (const auto& [wall, end] : {std::pair{48, 60}, std::pair{32, 24}, std::pair{24, 25}}) {
    SCOPED_TRACE(testing::Message() << wall << " and " << end << " corners");
    const double radius_m = 0.01, length_m = 0.05;
    const EdgeModel found = model_of(bar_with_cracks(radius_m, length_m, wall, end));
    const MeshQuality quality = mesh_quality(found);
    EXPECT_LT(quality.open_border_share, 0.05);
    EXPECT_NEAR(quality.drawn_m, 2 * 2 * std::numbers::pi * radius_m, 0.02 * quality.drawn_m);
    EXPECT_EQ(mesh_warning(found), "");
  }
}

TEST(MeshRepair, DrawsNoBorderThatLiesOnAFlatFace) {
  // A sheet, and a smaller one on it.
  const std::vector<Vector3d> x{{0, 0, 0},       {0.1, 0, 0},     {0.1, 0.1, 0},   {0, 0.1, 0},
                                {0.03, 0.03, 0}, {0.06, 0.03, 0}, {0.06, 0.06, 0}, {0.03, 0.06, 0}};
  const EdgeModel model =
      make_edge_model(make_mesh("sheets", x, {{0, 1, 2}, {0, 2, 3}, {4, 5, 6}, {4, 6, 7}}));
  EXPECT_EQ(model.creases.size(), 4u);
  EXPECT_NEAR(length_of(model), 0.4, 1e-12);
}

TEST(MeshRepair, DrawsABorderOnAFaceAtAnAngle) {
  // A sheet, and a fin that stands on it.
  const std::vector<Vector3d> x{{0, 0, 0},       {0.1, 0, 0},     {0.1, 0.1, 0},     {0, 0.1, 0},
                                {0.03, 0.04, 0}, {0.06, 0.04, 0}, {0.05, 0.04, 0.03}};
  const EdgeModel model = make_edge_model(make_mesh("fin", x, {{0, 1, 2}, {0, 2, 3}, {4, 5, 6}}));
  EXPECT_EQ(model.creases.size(), 7u);
}

TEST(MeshRepair, DrawsASurfaceThatIsThereTwiceOnce) {
  // The two copies have other diagonals.
  const std::vector<Vector3d> x{{0, 0, 0},   {0.1, 0, 0}, {0.1, 0.1, 0},
                                {0, 0.1, 0}, {0.2, 0, 0}, {0.2, 0.1, 0}};
  const EdgeModel model = make_edge_model(make_mesh(
      "twice", x,
      {{0, 1, 2}, {0, 2, 3}, {1, 4, 5}, {1, 5, 2}, {0, 3, 1}, {1, 3, 2}, {1, 2, 4}, {4, 2, 5}}));
  EXPECT_NEAR(length_of(model), 0.6, 1e-12) << "the border alone";
}

TEST(MeshRepair, KeepsTheInwardWallOfACavity) {
  Triangles solid = triangles_of(make_box({0.1, 0.1, 0.1}));
  const std::size_t outer = solid.triangles.size();
  const Triangles cavity = flipped(triangles_of(make_box({0.05, 0.05, 0.05})), 1, 0);
  for (auto triangle : cavity.triangles) {
    for (int& v : triangle) v += int(solid.vertices.size());
    solid.triangles.push_back(triangle);
  }
  solid.vertices.insert(solid.vertices.end(), cavity.vertices.begin(), cavity.vertices.end());
  const Mesh mesh = make_mesh("cavity", solid.vertices, solid.triangles);
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
    EXPECT_EQ(mesh.face_normals[t].dot(mesh.vertices_m[mesh.triangles[t][0]]) > 0, t < outer) << t;
  const Triangles inside_out = flipped(solid, 1, 0);
  const Mesh turned = make_mesh("inside out", inside_out.vertices, inside_out.triangles);
  for (std::size_t t = 0; t < turned.triangles.size(); ++t)
    EXPECT_GT(turned.face_normals[t].dot(turned.vertices_m[turned.triangles[t][0]]), 0)
        << (t < outer ? "outer" : "cavity");
}

// A strip with half a twist.
Triangles moebius() {
  Triangles strip;
  constexpr int pieces = 48;
  for (int i = 0; i < pieces; ++i) {
    const double angle = 2 * std::numbers::pi * i / pieces;
    const Vector3d outwards(std::cos(angle), std::sin(angle), 0);
    const Vector3d across =
        std::cos(angle / 2) * outwards + std::sin(angle / 2) * Vector3d::UnitZ();
    strip.vertices.push_back(0.05 * outwards - 0.01 * across);
    strip.vertices.push_back(0.05 * outwards + 0.01 * across);
  }
  for (int i = 0; i < pieces; ++i) {
    const int next = (i + 1) % pieces, twist = next == 0 ? 1 : 0;
    const int a = 2 * i, b = 2 * i + 1, c = 2 * next + twist, d = 2 * next + 1 - twist;
    strip.triangles.insert(strip.triangles.end(), {{a, c, d}, {a, d, b}});
  }
  return strip;
}

TEST(MeshRepair, WarnsOfAWindingThatCannotBeMended) {
  const EdgeModel model = model_of(moebius());
  const MeshQuality quality = mesh_quality(model);
  EXPECT_GT(quality.inconsistent_edges, 0u);
  EXPECT_EQ(quality.open_border_share, 1) << "the strip itself is smooth";
  EXPECT_NE(mesh_warning(model).find("winding"), std::string::npos) << mesh_warning(model);
}

TEST(MeshRepair, IsDoneOnce) {
  const Triangles spoilt = with_t_junctions(triangles_of(make_part("l_bracket").mesh), 1, 5);
  const Mesh mesh = make_mesh("once", spoilt.vertices, spoilt.triangles);
  const Mesh restored = restore_mesh("once", mesh.vertices_m, mesh.triangles);
  EXPECT_EQ(restored.vertices_m, mesh.vertices_m);
  EXPECT_EQ(restored.triangles, mesh.triangles);
  EXPECT_EQ(fingerprint(make_edge_model(restored)), fingerprint(make_edge_model(mesh)));
}

}  // namespace
}  // namespace edgescout::test
