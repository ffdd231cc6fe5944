#include "host/track/normal_fit.h"

#include <gtest/gtest.h>

#include "host/core/random.h"
#include "host/model/visible_edges.h"
#include "host/render/parts.h"
#include "kernels/pose_geometry.h"
#include "tests/track/flat_images.h"

namespace edgescout {
namespace {

// A search at `start` that found the edges of the part in its true pose.
struct PartAndEdges {
  Camera camera = test::flat_camera();
  Se3 truth, start;
  NormalSearch search;
};

void add_edge(NormalSearch& search, double offset_px, float contrast) {
  if (std::abs(offset_px) < search.reach_px) search.edges.push_back({float(offset_px), contrast});
}

PartAndEdges make_case(unsigned seed, const Vector6d& off, double wrong_share, double reach_px) {
  Random random(seed);
  PartAndEdges made;
  made.search.reach_px = reach_px;
  const Object part = make_part("l_bracket");
  const EdgeModel model = make_edge_model(part.mesh);
  made.truth = {random.rotation(), {0.01, -0.01, 0.45}};
  made.start = retract(made.truth, off);
  const auto backend = make_backend("cpu");
  const Pose at_start = to_pose(made.start), at_truth = to_pose(made.truth);
  const Intrinsics k = intrinsics_of(made.camera);
  const auto visible = visible_edges(model, {&made.start, 1}, *backend);
  for (const ModelPoint& point : visible[0]) {
    const auto from = project_edge(pose_point<double>(at_start, point), k),
               to = project_edge(pose_point<double>(at_truth, point), k);
    const double length = std::hypot(from.dx, from.dy);
    LinePoint line{point, from.u, from.v, -from.dy / length, from.dx / length, 0, 0, 10};
    line.first = std::uint32_t(made.search.edges.size());
    if (random.uniform() < wrong_share)
      add_edge(made.search, random.uniform(-reach_px, reach_px), -4);
    else
      add_edge(made.search, line.nx * (to.u - from.u) + line.ny * (to.v - from.v), 10);
    line.end = std::uint32_t(made.search.edges.size());
    made.search.points.push_back(line);
  }
  return made;
}

PosePrior wide(const Se3& pose) { return {pose, 10, 10}; }
Vector6d off_by(double metres, double radians) {
  Vector6d off;
  off << metres, -0.6 * metres, metres, radians, -radians, 0.5 * radians;
  return off;
}

TEST(NormalFit, FindsThePoseOfTheEdges) {
  const PartAndEdges t = make_case(1, off_by(0.002, 0.02), 0, 12);
  Se3 pose = fit_to_edges(t.search, t.camera, t.start, {6, 8}, wide(t.start));
  pose = fit_to_edges(t.search, t.camera, pose, {1, 8}, wide(pose));
  EXPECT_LT(distance_between_m(pose, t.truth), 3e-4);
  EXPECT_LT(angle_between_rad(pose, t.truth), 3e-3);
}

TEST(NormalFit, AThirdOfWrongEdgesDoNotMoveIt) {
  for (unsigned seed = 1; seed < 6; ++seed) {
    const PartAndEdges t = make_case(seed, off_by(0.0015, 0.015), 0.33, 12);
    Se3 pose = fit_to_edges(t.search, t.camera, t.start, {4, 8}, wide(t.start));
    pose = fit_to_edges(t.search, t.camera, pose, {1, 8}, wide(pose));
    EXPECT_LT(distance_between_m(pose, t.truth), 2e-3) << seed;
    EXPECT_LT(angle_between_rad(pose, t.truth), 0.012) << seed;
  }
}

TEST(NormalFit, StaysWhereTooFewEdgesAreFound) {
  PartAndEdges t = make_case(1, off_by(0.002, 0.02), 0, 12);
  t.search.points.resize(8);
  const Se3 pose = fit_to_edges(t.search, t.camera, t.start, {6, 8}, wide(t.start));
  EXPECT_EQ(distance_between_m(pose, t.start), 0);
}

TEST(NormalFit, TheShiftFindsWhatTheFitCannotReach) {
  Vector6d off = Vector6d::Zero();
  off << 0.017, -0.012, 0, 0, 0, 0;  // 16 and 11 px
  const PartAndEdges t = make_case(3, off, 0.2, 24);
  const Se3 shifted = shifted_to_edges(t.search, t.camera, t.start);
  EXPECT_LT(distance_between_m(shifted, t.truth) * t.camera.fx / 0.45, 2.5);
}

TEST(NormalFit, MeasuresRightPosesNearOneAndRandomEdgesNearZero) {
  const PartAndEdges right = make_case(1, Vector6d::Zero(), 0, 8),
                     random = make_case(1, Vector6d::Zero(), 1, 8);
  const NormalFit of_right = measure_fit(right.search, right.camera, right.truth),
                  of_random = measure_fit(random.search, random.camera, random.truth);
  EXPECT_GT(of_right.above_chance(), 0.98);
  EXPECT_LT(of_random.above_chance(), 0.1);
  EXPECT_TRUE(of_right.covariance.allFinite());
  EXPECT_GT(of_random.covariance.trace(), 4 * of_right.covariance.trace());
}

}  // namespace
}  // namespace edgescout
