// Tracking with a depth image beside each grey one.
#include <gtest/gtest.h>

#include "host/core/random.h"
#include "host/track/cropped_registration.h"
#include "kernels/error.h"
#include "tests/track/tracked_block.h"

namespace edgescout::test {
namespace {

// A depth sensor sees the part before a wall.
class DepthTrackerTest : public TrackerTest {
 protected:
  static constexpr double wall_m = 0.7;

  // z of the part in a pose, of the wall elsewhere; with noise.
  DepthImage depth_of(const Se3& pose, int seed) {
    const EdgeModel& model = sets[0].model;
    DepthImage depth{camera.width, camera.height, {}};
    depth.z_m.resize(std::size_t(camera.width) * std::size_t(camera.height));
    const DepthJob job{to_pose(pose), intrinsics_of(camera)};
    backend->depth_raster(model.triangle_mesh(), {&job, 1}, camera.width, camera.height, depth.z_m);
    Random random{unsigned(seed)};
    for (float& z_m : depth.z_m) {
      if (z_m == DEPTH_EMPTY) z_m = float(wall_m);
      z_m += float(noise.sigma_m(z_m) * random.normal());
    }
    return depth;
  }
  TrackFrame measured(TrackFrame frame, DepthImage depth) const {
    frame.depth = std::make_shared<const MeasuredDepth>(MeasuredDepth{std::move(depth), noise});
    return frame;
  }
  double axis_error_m(const Track& track, const Se3& truth) const {
    const Eigen::Vector3d center_m = sets[0].model.center_m;
    return std::abs((track.world_from_object * center_m).z() - (truth * center_m).z());
  }

  DepthNoise noise;
};

TEST_F(DepthTrackerTest, MeasuresTheDistance) {
  Tracker plain(sets, camera, *backend), deep(sets, camera, *backend);
  for (Tracker* tracker : {&plain, &deep}) tracker->add(0, pose_at(0));
  double of_plain_m = 0, of_deep_m = 0;
  for (int f = 0; f < 20; ++f) {
    const Track without = plain.update(frame(f))[0],
                with = deep.update(measured(frame(f), depth_of(pose_at(f), f)))[0];
    EXPECT_EQ(with.state, TrackState::Tracked) << f;
    EXPECT_LT(axis_error_m(with, pose_at(f)), 5e-4) << f;
    EXPECT_LT(with.covariance(2, 2), without.covariance(2, 2)) << f;
    of_plain_m += axis_error_m(without, pose_at(f));
    of_deep_m += axis_error_m(with, pose_at(f));
  }
  EXPECT_LT(of_deep_m, of_plain_m / 3);
}

TEST_F(DepthTrackerTest, WithoutAnyValueNothingChanges) {
  const DepthImage nothing{camera.width, camera.height,
                           std::vector<float>(std::size_t(camera.width) * camera.height)};
  Tracker plain(sets, camera, *backend), deep(sets, camera, *backend);
  for (Tracker* tracker : {&plain, &deep}) tracker->add(0, pose_at(0));
  for (int f = 0; f < 12; ++f) {
    const TrackFrame at = f == 6 ? empty(f) : frame(f, 9);  // one doubtful frame is registered
    const Track without = plain.update(at)[0], with = deep.update(measured(at, nothing))[0];
    EXPECT_EQ(with.state, without.state) << f;
    EXPECT_EQ(with.world_from_object.translation_m, without.world_from_object.translation_m) << f;
    EXPECT_EQ(with.world_from_object.rotation.coeffs(), without.world_from_object.rotation.coeffs())
        << f;
    EXPECT_EQ(with.covariance, without.covariance) << f;
  }
}

// A striped hand passes close before the part: its edges are many, and where the part's were.
TEST_F(DepthTrackerTest, AHandBeforeThePartDoesNotPullThePose) {
  Tracker tracker(sets, camera, *backend);
  tracker.add(0, pose_at(0));
  int last_tracked = 0;
  for (int f = 0; f < 24; ++f) {
    Image image = flat_of(pose_at(f));
    DepthImage depth = depth_of(pose_at(f), f);
    const int tips_px = 200 - 6 * f;  // they reach from the right side
    for (int y = 0; y < camera.height; ++y)
      for (int x = std::max(0, tips_px); x < camera.width; ++x) {
        if ((y / 5) % 4 == 0) continue;
        const std::size_t pixel = std::size_t(y) * std::size_t(camera.width) + std::size_t(x);
        image.pixels[pixel] = (x / 6) % 2 ? 200 : 60;
        depth.z_m[pixel] = 0.3f;
      }
    const TrackFrame at{std::make_shared<const Image>(image), 0.1 * f};
    const Track track = tracker.update(measured(at, depth))[0];
    if (track.state != TrackState::Tracked) continue;
    EXPECT_LT(error(track, pose_at(f)), 0.08) << f;
    last_tracked = f;
  }
  EXPECT_GT(last_tracked, 8);  // with fingers over the part
}

// The image still shows the part, but the sensor saw the wall through it.
TEST_F(DepthTrackerTest, APoseThatDepthContradictsIsDoubtful) {
  Tracker tracker(sets, camera, *backend);
  tracker.add(0, pose_at(0));
  for (int f = 0; f < 3; ++f) tracker.update(measured(frame(f), depth_of(pose_at(f), f)));
  EXPECT_EQ(tracker.tracks()[0].state, TrackState::Tracked);
  const DepthImage wall = depth_of({Eigen::Quaterniond::Identity(), {0, 0, -1}}, 3);
  EXPECT_EQ(tracker.update(measured(frame(3), wall))[0].state, TrackState::Doubtful);
}

TEST_F(DepthTrackerTest, DoubtfulPosesAreRegisteredWithDepth) {
  const Se3 truth = pose_at(3);
  Vector6d off;
  off << 0.008, -0.006, 0.025, 0.15, -0.1, 0.1;
  const Se3 start = retract(truth, off);
  const Image image = flat_of(truth);
  const MeasuredDepth depth{depth_of(truth, 1), noise};
  const std::optional<Detection> found =
      register_in_crop(searched(image, camera, &depth), sets[0].model, {&start, 1}, *backend, {});
  ASSERT_TRUE(found);
  const double z_m = (found->world_from_object * sets[0].model.center_m).z();
  EXPECT_NEAR(z_m, (truth * sets[0].model.center_m).z(), 3e-4);
}

TEST_F(DepthTrackerTest, ASearchUsesIt) {
  TemplateOptions templates;
  templates.distance_min_m = 0.39;
  templates.distance_max_m = 0.41;
  sets = {build_templates(block, templates, *backend)};
  Tracker tracker(sets, camera, *backend);
  DepthImage before = depth_of({Eigen::Quaterniond::Identity(), {0, 0, -1}}, 0);
  for (float& z_m : before.z_m) z_m = 0.2f;  // a wall before all that the search could find
  EXPECT_EQ(tracker.search(measured(frame(0), before), *backend), 0);
  EXPECT_EQ(tracker.search(measured(frame(0), depth_of(pose_at(0), 0)), *backend), 1);
}

TEST_F(DepthTrackerTest, RefusesDepthOfAnotherSize) {
  Tracker tracker(sets, camera, *backend);
  tracker.add(0, pose_at(0));
  const DepthImage small{16, 16, std::vector<float>(256)}, cut{camera.width, camera.height, {}};
  EXPECT_THROW(tracker.update(measured(frame(0), small)), InputError);
  EXPECT_THROW(tracker.search(measured(frame(0), cut), *backend), InputError);
}

}  // namespace
}  // namespace edgescout::test
