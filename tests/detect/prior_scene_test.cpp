// A rendered scene of two parts with a prior in the world: what lies outside is not found.
#include <gtest/gtest.h>

#include "kernels/error.h"
#include "tests/detect/rendered_part.h"

namespace edgescout::test {
namespace {

struct SceneWithPrior : RenderedPart {
  std::unique_ptr<Backend> backend = make_cpu_backend(2);

  explicit SceneWithPrior(int views = 1) : RenderedPart("bearing_block", views, 2) {}

  Eigen::Vector3d center_m(std::size_t placed) const {
    return scene.placed[placed].world_from_object * sets[0].model.center_m;
  }
  // A cube in the world, with room for the error of a pose along the line of sight.
  WorldPrior around(const Eigen::Vector3d& center) const {
    WorldPrior prior;
    for (const double sign : {-1.0, 1.0})
      for (int axis = 0; axis < 3; ++axis) prior.box_m.push_back(center[axis] + sign * 0.015);
    return prior;
  }

  Detections detect(const WorldPrior& prior) const {
    PipelineOptions all = options();
    all.detect.coarse_poses = all.detect.coarse_poses_joint = 600;
    all.detect.medium_poses = all.detect.medium_poses_joint = 100;
    all.detect.scan.world = prior;
    std::vector<ObjectView> views;
    for (std::size_t v = 0; v < scene.views.size(); ++v)
      views.push_back(prepared(v, scene.views[v].camera_from_world, *backend));
    return views.size() > 1 ? detect_jointly(views, sets, *backend, all)
                            : detect_objects(views[0], sets, *backend, all);
  }
  // Detections in one view are in its camera frame.
  Se3 in_world(const Detection& found) const {
    return scene.views.size() > 1
               ? found.world_from_object
               : inverse(scene.views[0].camera_from_world) * found.world_from_object;
  }
  bool finds(const Detections& found, std::size_t placed) const {
    return std::ranges::any_of(found.detections, [&](const Detection& d) {
      return error(in_world(d), scene.placed[placed].world_from_object).passes();
    });
  }
  bool all_within(const Detections& found, const WorldPrior& prior) const {
    return std::ranges::all_of(found.detections, [&](const Detection& d) {
      return prior.box().contains(in_world(d) * sets[0].model.center_m);
    });
  }
};

void expect_the_one_in_the_box(const SceneWithPrior& t) {
  const Detections everywhere = t.detect({});
  for (const std::size_t i : {0, 1}) EXPECT_TRUE(t.finds(everywhere, i)) << i;
  for (const std::size_t i : {0, 1}) {
    const WorldPrior prior = t.around(t.center_m(i));
    ASSERT_FALSE(prior.box().contains(t.center_m(1 - i)));
    const Detections found = t.detect(prior);
    EXPECT_TRUE(t.finds(found, i)) << i;
    EXPECT_FALSE(t.finds(found, 1 - i)) << i;
    EXPECT_TRUE(t.all_within(found, prior)) << i;
  }
  EXPECT_TRUE(t.detect(t.around({0.3, 0.3, 0})).detections.empty());
}

TEST(WorldPrior, KeepsDetectionInOneImageToABox) { expect_the_one_in_the_box(SceneWithPrior()); }

TEST(WorldPrior, KeepsJointDetectionToABox) { expect_the_one_in_the_box(SceneWithPrior(2)); }

// The board is the world's plane z = 0.
TEST(WorldPrior, KeepsDetectionAboveAPlane) {
  const SceneWithPrior t;
  WorldPrior board;
  board.plane = {0, 0, 1, 0};
  const Detections found = t.detect(board);
  for (const std::size_t i : {0, 1}) EXPECT_TRUE(t.finds(found, i)) << i;
  for (const Detection& d : found.detections)
    for (const Eigen::Vector3d& vertex : t.part.mesh.vertices_m)
      EXPECT_GE((t.in_world(d) * vertex).z(), -board.plane_tolerance_m - 1e-9);
  board.plane[3] = 0.1;  // above the parts
  EXPECT_TRUE(t.detect(board).detections.empty());
}

TEST(WorldPrior, IsValidatedWithTheOptionsOfDetection) {
  DetectOptions options;
  options.scan.world.plane = {0, 0, 0, 0};
  EXPECT_THROW(options.validate(), InputError);
}

}  // namespace
}  // namespace edgescout::test
