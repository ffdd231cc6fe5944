// Poses that leave an optimum of the edge ICP for a better one beside it.
#include <gtest/gtest.h>

#include <memory>

#include "host/register/edge_icp.h"
#include "host/register/pose_classifier.h"
#include "host/register/refine.h"
#include "tests/register/scene.h"

namespace edgescout {
namespace {

using namespace test;

// A part before a camera, as its edges show it, and rounds that reach no further than 1.5 px.
struct Known {
  std::unique_ptr<Backend> backend = make_cpu_backend(2);
  EdgeModel model = part_model("l_bracket");
  Se3 camera_from_object{Eigen::Quaterniond(0.8, 0.4, -0.3, 0.3).normalized(), {0.01, -0.01, 0.5}};
  ObjectView view;
  EdgeIcpOptions options;

  Known() {
    view.camera = scene_camera();
    view.edges = std::make_shared<EdgeIndex>(
        ideal_edges(part_model("l_bracket", 2e-4), view.camera, camera_from_object, *backend),
        view.camera.width, view.camera.height);
    options.rounds = {{1.5f, 1.2f, 8}};
  }
  Scene scene() const { return {{&model, 1}, {&view, 1}, *backend}; }

  // Turned about an axis across the line of sight.
  PoseEstimate tilted(double angle_rad) const {
    Vector6d turn = Vector6d::Zero();
    turn.tail<3>() = angle_rad * Eigen::Vector3d::UnitX();
    PoseEstimate estimate;
    estimate.object = 0;
    estimate.world_from_object = retract_about(camera_from_object, model.center_m, turn);
    return estimate;
  }
  double angle_off_rad(const PoseEstimate& estimate) const {
    return angle_between_rad(estimate.world_from_object, camera_from_object);
  }
};

TEST(BasinHopping, FindsTheBetterOptimumBeside) {
  const Known known;
  std::vector<PoseEstimate> poses{known.tilted(0.15), known.tilted(-0.15)};
  edge_icp(known.scene(), poses, known.options);
  for (const PoseEstimate& pose : poses)
    ASSERT_GT(known.angle_off_rad(pose), 0.03) << "the iterations alone reach it";
  EXPECT_EQ(hop_basins(known.scene(), poses, known.options), (std::vector<std::size_t>{0, 1}));
  for (const PoseEstimate& pose : poses) {
    EXPECT_LT(known.angle_off_rad(pose), 0.01);
    EXPECT_GT(pose.explained, 0.8);
    EXPECT_TRUE(pose.covariance.allFinite());
  }
}

TEST(BasinHopping, StaysWhereNothingBesideIsBetter) {
  const Known known;
  std::vector<PoseEstimate> poses{known.tilted(0)};
  edge_icp(known.scene(), poses, known.options);
  const Se3 before = poses[0].world_from_object;
  EXPECT_TRUE(hop_basins(known.scene(), poses, known.options).empty());
  EXPECT_LT(angle_between_rad(before, poses[0].world_from_object), 0.005);
}

TEST(BasinHopping, NeedsEdges) {
  const Known known;
  ObjectView without = known.view;
  without.edges = nullptr;
  std::vector<PoseEstimate> poses{known.tilted(0.15)};
  hop_basins({{&known.model, 1}, {&without, 1}, *known.backend}, poses, known.options);
  EXPECT_NEAR(known.angle_off_rad(poses[0]), 0.15, 1e-9);
}

// With a tensor, so that features can be measured. There is no image: the log-odds are minus the
// mean tensor value.
TEST(BasinHopping, MovesProbablePosesAndOnePoseOnce) {
  Known known;
  known.view.tensor =
      view_of(part_model("l_bracket", 2e-4), known.camera_from_object, {}, *known.backend).tensor;
  std::vector<PoseEstimate> poses{known.tilted(0.15), known.tilted(0.1505), known.tilted(-0.15),
                                  known.tilted(0.15)};
  RefineOptions options;
  options.edge_icp = known.options;
  measure_features(known.scene(), poses, {options.score, options.d2co.visibility});
  poses[0].features[0].mean_px = 3;
  poses[1].features[0].mean_px = 2;  // the same pose, more probable
  poses[2].features[0].mean_px = 3.5;
  poses[3].features[0].mean_px = 5;  // not probable
  for (PoseEstimate& pose : poses) classify(pose);
  hop_probable(known.scene(), poses, options);
  for (const int i : {0, 1, 2}) {
    EXPECT_LT(known.angle_off_rad(poses[std::size_t(i)]), 0.01) << i;
    EXPECT_LT(poses[std::size_t(i)].features[0].mean_px, 1.5) << i << ": features of its new pose";
  }
  EXPECT_EQ(poses[0].world_from_object.translation_m, poses[1].world_from_object.translation_m);
  EXPECT_NEAR(known.angle_off_rad(poses[3]), 0.15, 1e-9);
}

}  // namespace
}  // namespace edgescout
