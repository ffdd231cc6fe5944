// What known objects hide, compared with rays through all triangles, and its effect on the features
// and registration of a covered pose.
#include "host/register/occluders.h"

#include <gtest/gtest.h>

#include <cmath>

#include "host/register/d2co_ceres.h"
#include "host/register/pose_features.h"
#include "tests/register/scene.h"
#include "tests/test_random.h"

namespace edgescout::test {
namespace {

// Smallest z, m, at which the ray (x, y, 1) meets the mesh; infinite where it misses.
double first_hit_m(const Mesh& mesh, const Se3& camera_from_object, const Eigen::Vector3d& ray) {
  double nearest = INFINITY;
  for (const auto& corner : mesh.triangles) {
    Eigen::Matrix3d corners;
    for (int c = 0; c < 3; ++c)
      corners.col(c) = camera_from_object * mesh.vertices_m[std::size_t(corner[std::size_t(c)])];
    // ray * z = corners * barycentric, barycentric summing to one.
    const Eigen::Vector3d weights = corners.inverse() * ray;
    if (weights.minCoeff() >= 0 && weights.sum() > 0)
      nearest = std::min(nearest, 1 / weights.sum());
  }
  return nearest;
}

Eigen::Vector3d middle_of_largest_triangle(const Mesh& mesh) {
  double largest = 0;
  Eigen::Vector3d middle = Eigen::Vector3d::Zero();
  for (const auto& [i, j, k] : mesh.triangles) {
    const Eigen::Vector3d a = mesh.vertices_m[std::size_t(i)], b = mesh.vertices_m[std::size_t(j)],
                          c = mesh.vertices_m[std::size_t(k)];
    const double area = (b - a).cross(c - a).norm();
    if (area > largest) largest = area, middle = (a + b + c) / 3;
  }
  return middle;
}

TEST(Occluders, HideWhatLiesBehindThemAlongRays) {
  Random random = test_random();
  const auto backend = make_reference_backend();
  const EdgeModel model = part_model("l_bracket");
  const Se3 known{random.rotation(), {0.01, -0.01, 0.4}};
  ObjectView view;
  view.camera = scene_camera();
  const ObjectPose pose{0, known};
  const auto occluders = make_occluders({&model, 1}, {&pose, 1}, view, *backend);
  ASSERT_NE(occluders, nullptr);
  const double tolerance_m = 0.004;
  int hidden = 0, shown = 0;
  for (int i = 0; i < 4000; ++i) {
    const Eigen::Vector3d point =
        known.translation_m + 0.06 * random.uniform(0, 1) * random.direction();
    const Eigen::Vector2d pixel = project(occluders->camera, point).array().round();
    double farthest = 0;  // around it, of the nearest surfaces
    bool edge_on = false;
    for (int y = -1; y <= 1; ++y)
      for (int x = -1; x <= 1; ++x) {
        const Eigen::Vector3d ray = ray_through(occluders->camera, pixel + Eigen::Vector2d(x, y));
        const double z = first_hit_m(model.mesh, known, ray),
                     neighbour =
                         first_hit_m(model.mesh, known, ray + Eigen::Vector3d(1e-6, 1e-6, 0));
        edge_on |= std::abs(z - neighbour) > 1e-4 || std::isinf(z) != std::isinf(neighbour);
        farthest = std::max(farthest, z);
      }
    if (edge_on || std::abs(farthest + tolerance_m - point.z()) < 1e-5) continue;
    const bool expected = farthest < point.z() - tolerance_m;
    EXPECT_EQ(occluders->hide(point, tolerance_m), expected) << point.transpose();
    ++(expected ? hidden : shown);
  }
  EXPECT_GT(hidden, 200);
  EXPECT_GT(shown, 200);
}

TEST(Occluders, HideNothingOutsideTheImageOrBehindTheCamera) {
  const auto backend = make_reference_backend();
  const EdgeModel model = part_model("l_bracket");
  ObjectView view;
  view.camera = scene_camera();
  const ObjectPose near{0, {Eigen::Quaterniond::Identity(), {0, 0, 0.2}}};
  const auto occluders = make_occluders({&model, 1}, {&near, 1}, view, *backend);
  EXPECT_TRUE(occluders->hide(5 * (near.world_from_object * middle_of_largest_triangle(model.mesh)),
                              0.001));
  EXPECT_FALSE(occluders->hide({0, 0, -1}, 0.001));
  EXPECT_FALSE(occluders->hide({9, 0, 1}, 0.001));
  const ObjectPose behind{0, {Eigen::Quaterniond::Identity(), {0, 0, -0.5}}};
  EXPECT_FALSE(make_occluders({&model, 1}, {&behind, 1}, view, *backend)->hide({0, 0, 1}, 0.001));
  EXPECT_EQ(make_occluders({&model, 1}, {}, view, *backend), nullptr);
}

// A bracket half covered by a block in front of it: the edges of both by an ideal detector.
struct CoveredPart {
  std::unique_ptr<Backend> backend = make_cpu_backend(2);
  std::vector<EdgeModel> models{part_model("l_bracket"), part_model("bearing_block")};
  ObjectPose covered, cover;
  ObjectView view;
  double share = 0;  // of the bracket's edge that is hidden

  explicit CoveredPart(Random& random) {
    covered = {0, {random.rotation(), {0, 0, 0.42}}};
    cover = {1, {random.rotation(), {0.03, 0.01, 0.3}}};
    const EdgeModel dense = part_model("l_bracket", 2e-4);
    std::vector<EdgePoint> edges = ideal_edges(part_model("bearing_block", 2e-4), scene_camera(),
                                               cover.world_from_object, *backend);
    const std::vector<ModelPoint> own =
        visible_edges(dense, {&covered.world_from_object, 1}, *backend)[0];
    const Camera camera = scene_camera();
    const Intrinsics k = intrinsics_of(camera);
    std::size_t hidden = 0;
    for (const ModelPoint& point : own) {
      const Eigen::Vector3d x =
          covered.world_from_object * Eigen::Vector3d(point.x_m, point.y_m, point.z_m);
      if (first_hit_m(models[1].mesh, cover.world_from_object, x / x.z()) < x.z()) {
        ++hidden;
        continue;
      }
      const Landing at = land(k, covered.world_from_object, point);
      edges.push_back({float(at.u), float(at.v), float(at.theta), 1});
    }
    share = double(hidden) / double(own.size());
    view.camera = camera;
    view.tensor = backend->make_view(edges, camera.width, camera.height, {}, k, {});
  }
  void set_occluders() { view.occluders = make_occluders(models, {&cover, 1}, view, *backend); }
  PoseFeatures features_of(const ObjectPose& pose) const {
    return pooled_features({models, {&view, 1}, *backend}, {&pose, 1}, {{}, {}})[0];
  }
  PoseEstimate registered() const {
    return register_poses({models, {&view, 1}, *backend}, {&covered, 1})[0];
  }
};

// At least two parts, each with a quarter to seven tenths hidden.
std::vector<CoveredPart> half_covered_parts(Random& random) {
  std::vector<CoveredPart> parts;
  for (int i = 0; i < 6; ++i) {
    CoveredPart part(random);
    if (part.share >= 0.25 && part.share <= 0.7) parts.push_back(std::move(part));
  }
  EXPECT_GE(parts.size(), 2u);
  return parts;
}

TEST(Occluders, WhatTheyHideCountsNeitherForNorAgainstAPose) {
  Random random = test_random();
  for (CoveredPart& t : half_covered_parts(random)) {
    const PoseFeatures blind = t.features_of(t.covered);
    t.set_occluders();
    const PoseFeatures knowing = t.features_of(t.covered);
    EXPECT_EQ(knowing.visible, blind.visible);
    EXPECT_NEAR(knowing.points / blind.points, 1 - t.share, 0.08);
    EXPECT_NEAR(knowing.in_image, 1 - t.share, 0.08) << "what is hidden is not in the image";
    EXPECT_LT(knowing.length_px, blind.length_px);
    EXPECT_LT(knowing.mean_px, 0.5 * blind.mean_px);
    EXPECT_LT(knowing.mean_px, 2);
  }
}

TEST(Occluders, RegistrationLeavesOutWhatTheyHide) {
  Random random = test_random();
  for (CoveredPart& t : half_covered_parts(random)) {
    const PoseEstimate blind = t.registered();
    t.set_occluders();
    const PoseEstimate knowing = t.registered();
    EXPECT_LT(knowing.points, 0.85 * blind.points);
    EXPECT_LT(knowing.mean_px, blind.mean_px);
  }
}

// The reference of the batched solver uses the same points.
TEST(Occluders, CeresLeavesOutTheSame) {
  Random random = test_random();
  for (CoveredPart& t : half_covered_parts(random)) {
    t.set_occluders();
    const PoseEstimate batched = t.registered(),
                       ceres = register_poses_ceres({t.models, {&t.view, 1}, *t.backend},
                                                    {&t.covered, 1})[0];
    EXPECT_NEAR(ceres.points, batched.points, 0.02 * batched.points);
    EXPECT_NEAR(ceres.mean_px, batched.mean_px, 0.05);
  }
}

TEST(Occluders, AKnownObjectDoesNotHideItself) {
  Random random = test_random();
  CoveredPart t(random);
  const PoseFeatures alone = t.features_of(t.cover);
  t.set_occluders();
  const PoseFeatures known = t.features_of(t.cover);
  // It does hide a few points near contours, which visible_edges keeps.
  EXPECT_GT(known.points, 0.99 * alone.points);
  EXPECT_NEAR(known.mean_px, alone.mean_px, 0.01);
}

}  // namespace
}  // namespace edgescout::test
