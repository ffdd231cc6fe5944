// The edges of a mesh that can be visible.
#include "host/model/edge_model.h"

#include <gtest/gtest.h>

#include <limits>
#include <numbers>

#include "host/render/parts.h"
#include "kernels/error.h"
#include "tests/io/expect_input_error.h"
#include "tests/model/solids.h"

namespace edgescout {
namespace {

using test::icosphere;

TEST(EdgeModel, CubeHasItsTwelveEdgesAndNoDiagonal) {
  const EdgeModel model = make_edge_model(make_box({0.1, 0.1, 0.1}));
  ASSERT_EQ(model.creases.size(), 12u);
  double along[3] = {};
  for (const EdgeModel::Segment& s : model.creases) {
    EXPECT_NEAR((s.to_m - s.from_m).norm(), 0.1, 1e-12);
    for (int i = 0; i < 3; ++i) along[i] += std::abs(s.to_m[i] - s.from_m[i]);
  }
  for (const double length : along) EXPECT_NEAR(length, 0.4, 1e-12);  // four each way
  EXPECT_TRUE(model.curved.empty());
  for (std::size_t t = 0; t < model.corner_normals.size(); ++t)
    for (const Eigen::Vector3d& normal : model.corner_normals[t])
      EXPECT_NEAR((normal - model.mesh.face_normals[t]).norm(), 0, 1e-12);
}

TEST(EdgeModel, FramesTheMesh) {
  const EdgeModel model = make_edge_model(make_box({0.1, 0.2, 0.3}));
  EXPECT_NEAR(model.center_m.norm(), 0, 1e-12);
  EXPECT_NEAR(model.radius_m, 0.5 * std::sqrt(0.01 + 0.04 + 0.09), 1e-12);
  EXPECT_NEAR(model.raster_step_m, model.mesh.diameter_m / 80, 1e-12);
}

TEST(EdgeModel, IsToldFromOthersByItsFingerprint) {
  const auto of = [](double height_m, const EdgeModelOptions& options = {}) {
    return fingerprint(make_edge_model(make_box({0.1, 0.2, height_m}), options));
  };
  EXPECT_EQ(of(0.3), of(0.3));
  EXPECT_NE(of(0.3), of(0.3 + 1e-9));
  EXPECT_NE(of(0.3), of(0.3, {.crease_angle_deg = 120})) << "no edge of a box is that sharp";
  EXPECT_NE(of(0.3), of(0.3, {.raster_step_m = 0.001}));
  EdgeModel turned_inside_out = make_edge_model(make_box({0.1, 0.2, 0.3}));
  for (auto& triangle : turned_inside_out.mesh.triangles) std::swap(triangle[0], triangle[1]);
  EXPECT_NE(of(0.3), fingerprint(turned_inside_out));
}

TEST(EdgeModel, OpenBordersShow) {
  const EdgeModel sheet = make_edge_model(make_mesh(
      "sheet", {{0, 0, 0}, {0.1, 0, 0}, {0.1, 0.1, 0}, {0, 0.1, 0}}, {{0, 1, 2}, {0, 2, 3}}));
  EXPECT_EQ(sheet.creases.size(), 4u);
}

TEST(EdgeModel, AnEdgeOfThreeFacesIsDrawnOnce) {
  const EdgeModel fins = make_edge_model(
      make_mesh("fins", {{0, 0, 0}, {0, 0, 0.1}, {0.1, 0, 0}, {-0.1, 0.1, 0}, {-0.1, -0.1, 0}},
                {{0, 1, 2}, {0, 1, 3}, {0, 1, 4}}));
  EXPECT_EQ(fins.creases.size(), 7u);  // the spine and two free edges per fin
}

TEST(EdgeModel, SphereHasNoCreasesAndRadialNormals) {
  const EdgeModel model = make_edge_model(icosphere(0.05, 3));
  EXPECT_TRUE(model.creases.empty());
  EXPECT_EQ(model.curved.size(), model.mesh.triangles.size());
  for (std::size_t t = 0; t < model.mesh.triangles.size(); ++t)
    for (int c = 0; c < 3; ++c) {
      const Eigen::Vector3d radial = model.mesh.vertices_m[model.mesh.triangles[t][c]].normalized();
      EXPECT_GT(model.corner_normals[t][c].dot(radial), std::cos(2 * std::numbers::pi / 180));
    }
}

TEST(EdgeModel, CylinderHasRimsAndACurvedSide) {
  const double radius = 0.02, length = 0.1;
  const EdgeModel model = make_edge_model(make_bar(radius, length));
  double rims = 0;
  for (const EdgeModel::Segment& s : model.creases) {
    EXPECT_NEAR(std::abs(s.from_m.z()), length / 2, 1e-9);
    EXPECT_NEAR(s.from_m.z(), s.to_m.z(), 1e-9);
    rims += (s.to_m - s.from_m).norm();
  }
  EXPECT_NEAR(rims, 2 * 2 * std::numbers::pi * radius, 0.01 * 4 * std::numbers::pi * radius);
  EXPECT_FALSE(model.curved.empty());
  for (const int t : model.curved)
    for (const Eigen::Vector3d& normal : model.corner_normals[t])
      EXPECT_NEAR(normal.z(), 0, 1e-9) << "stays off the caps";
}

TEST(EdgeModel, CreaseAngleDecides) {
  // A roof of 40 degrees between its sides' normals.
  const double h = 0.1 * std::tan(20 * std::numbers::pi / 180);
  const Mesh roof = make_mesh(
      "roof", {{-0.1, 0, 0}, {0.1, 0, 0}, {0, 0, h}, {-0.1, 0.2, 0}, {0.1, 0.2, 0}, {0, 0.2, h}},
      {{0, 2, 5}, {0, 5, 3}, {2, 1, 4}, {2, 4, 5}});
  const auto creases = [&](double angle_deg) {
    EdgeModelOptions options;
    options.crease_angle_deg = angle_deg;
    return make_edge_model(roof, options).creases.size();
  };
  EXPECT_EQ(creases(39), 7u);  // six of the border, one ridge
  EXPECT_EQ(creases(41), 6u);
}

TEST(EdgeModel, RefusesOptionsOutOfRange) {
  const Mesh box = make_box({0.1, 0.1, 0.1});
  constexpr double nan = std::numeric_limits<double>::quiet_NaN();
  for (const double angle : {0.0, -5.0, 180.0, nan}) {
    EdgeModelOptions options;
    options.crease_angle_deg = angle;
    EXPECT_THROW(make_edge_model(box, options), InputError) << angle;
  }
  for (const double step : {-1e-3, 1.0, nan}) {
    EdgeModelOptions options;
    options.raster_step_m = step;
    EXPECT_THROW(make_edge_model(box, options), InputError) << step;
  }
}

TEST(EdgeModel, RefusesAStepThatMakesTooManyPoints) {
  for (const double step_m : {1e-9, 1e-80}) {
    EdgeModelOptions options;
    options.raster_step_m = step_m;
    test::expect_input_error([&] { make_edge_model(make_part("l_bracket").mesh, options); },
                             {"l_bracket", "raster step", "m for edges of", "at least"});
  }
}

TEST(EdgeModel, RejectsAMeshThatShowsNoEdge) {
  // So long a step puts no point on any of the box's edges.
  test::expect_input_error(
      [] {
        test::model_of(make_box({0.01, 0.01, 0.01}), 0.9);
      },
      {"box: edges", "none", "raster step"});
}

}  // namespace
}  // namespace edgescout
