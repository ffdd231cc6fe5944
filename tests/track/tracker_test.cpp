#include "host/track/tracker.h"

#include <gtest/gtest.h>

#include <atomic>
#include <thread>

#include "host/core/pose_error.h"
#include "host/core/random.h"
#include "host/experiments/moving_scene.h"
#include "host/render/parts.h"
#include "host/track/cropped_registration.h"
#include "kernels/error.h"
#include "kernels/thread_pool.h"
#include "tests/track/flat_images.h"

namespace edgescout {
namespace {

const Object block = make_part("bearing_block");
// Goes to the right and turns: some 4 px and 0.03 rad a frame.
Se3 pose_at(int frame) {
  return {so3_exp({0.5 + 0.01 * frame, -0.4 + 0.025 * frame, 0.3}),
          {-0.06 + 0.004 * frame, 0.01, 0.4 + 0.002 * frame}};
}

class TrackerTest : public testing::Test {
 protected:
  TrackFrame frame(int number, int stripes_px = 0) {
    return {std::make_shared<const Image>(flat_of(pose_at(number), stripes_px)), 0.1 * number};
  }
  TrackFrame empty(int number) const {
    return {std::make_shared<const Image>(
                Image{camera.width, camera.height, std::vector<std::uint8_t>(320 * 240, 35)}),
            0.1 * number};
  }
  Image flat_of(const Se3& pose, int stripes_px = 0) {
    return test::flat_image(block.mesh, pose, pool, camera, stripes_px);
  }
  static double error(const Track& track, const Se3& truth) {
    return mssd_m(track.world_from_object, truth, block) / block.mesh.diameter_m;
  }

  ThreadPool pool{2};
  Camera camera = test::flat_camera();
  std::unique_ptr<Backend> backend = make_backend("cpu");
  std::vector<TemplateSet> sets{without_views(block)};
};

TEST_F(TrackerTest, FollowsAPartThatMovesAndTurns) {
  for (const int stripes_px : {0, 9}) {
    Tracker tracker(sets, camera, *backend);
    EXPECT_EQ(tracker.add(0, pose_at(0)), 1);
    for (int f = 0; f < 25; ++f) {
      const std::vector<Track>& tracks = tracker.update(frame(f, stripes_px));
      ASSERT_EQ(tracks.size(), 1u);
      EXPECT_EQ(tracks[0].state, TrackState::Tracked) << f << " " << tracks[0].above_chance;
      EXPECT_LT(error(tracks[0], pose_at(f)), 0.04) << f;
      EXPECT_LT(tracks[0].covariance.trace(), 1e-3) << f;
    }
  }
}

// The first pose is that of a person: 6 px off and turned.
TEST_F(TrackerTest, StartsFromARoughPose) {
  Tracker tracker(sets, camera, *backend);
  Vector6d off;
  off << 0.006, -0.004, 0.01, 0.06, -0.05, 0.05;
  tracker.add(0, retract(pose_at(0), off));
  tracker.update(frame(0));
  EXPECT_LT(error(tracker.update(frame(1))[0], pose_at(1)), 0.03);
}

// The edges of something that comes before the part turn its pose as far in one frame. A part that
// did turn so is registered, which judges the pose.
TEST_F(TrackerTest, EdgesAloneDoNotTurnAPoseFurtherThanPartsTurn) {
  const auto turned_by = [&](double angle_rad, bool registers) {
    TrackOptions options;
    options.register_doubtful = registers;
    Tracker tracker(sets, camera, *backend, options);
    tracker.add(0, pose_at(0));
    for (int f = 0; f < 4; ++f) tracker.update(frame(f));
    const Se3 turned{so3_exp({0, 0, angle_rad}) * pose_at(4).rotation, pose_at(4).translation_m};
    const Track track = tracker.update({std::make_shared<const Image>(flat_of(turned)), 0.4})[0];
    return std::pair(track.state, angle_between_rad(track.world_from_object, pose_at(4)));
  };
  for (const bool registers : {false, true}) {
    const auto [state, angle_rad] = turned_by(0.15, registers);
    EXPECT_EQ(state, TrackState::Tracked);
    EXPECT_NEAR(angle_rad, 0.15, 0.02);
  }
  for (const double far_rad : {0.28, 0.4}) {
    const auto [state, angle_rad] = turned_by(far_rad, false);
    EXPECT_EQ(state, TrackState::Doubtful) << far_rad;
    EXPECT_LT(angle_rad, 0.05) << far_rad;
    const auto [state_registered, angle_registered_rad] = turned_by(far_rad, true);
    EXPECT_EQ(state_registered, TrackState::Tracked) << far_rad;
    EXPECT_NEAR(angle_registered_rad, far_rad, 0.02) << far_rad;
  }
}

// In an image whose part is registered in a reduced crop.
TEST_F(TrackerTest, BringsARegisteredPoseOntoTheEdgesOfALargeImage) {
  camera = scaled(camera, 3);
  TrackOptions no_registration;
  no_registration.register_doubtful = false;
  Vector6d off;
  off << 0.008, -0.006, 0.014, 0.16, -0.12, 0.14;
  const auto updated = [&](const TrackOptions& options) {
    Tracker tracker(sets, camera, *backend, options);
    tracker.add(0, retract(pose_at(0), off));
    return tracker.update(frame(0))[0];
  };
  EXPECT_EQ(updated(no_registration).state, TrackState::Doubtful);
  const Track track = updated({});
  EXPECT_EQ(track.state, TrackState::Tracked) << track.above_chance;
  EXPECT_LT(error(track, pose_at(0)), 0.005);
}

TEST_F(TrackerTest, IsDoubtfulThenLostWhereThePartIsGone) {
  TrackOptions options;
  options.doubtful_frames = 3;
  Tracker tracker(sets, camera, *backend, options);
  tracker.add(0, pose_at(0));
  for (int f = 0; f < 5; ++f) tracker.update(frame(f));
  double last = tracker.tracks()[0].covariance(0, 0);
  for (int f = 5; f < 8; ++f) {
    const Track track = tracker.update(empty(f))[0];
    EXPECT_EQ(track.state, TrackState::Doubtful) << f;
    EXPECT_GT(track.covariance(0, 0), last);
    last = track.covariance(0, 0);
    EXPECT_LT(error(track, pose_at(f)), 0.25) << f;  // predicted
  }
  EXPECT_EQ(tracker.update(empty(8))[0].state, TrackState::Lost);
  // It returns near by: nobody looks for it.
  EXPECT_EQ(tracker.update(frame(9))[0].state, TrackState::Lost);
}

TEST_F(TrackerTest, GoesOnWhereThePartReturnsInTime) {
  Tracker tracker(sets, camera, *backend);
  tracker.add(0, pose_at(0));
  for (int f = 0; f < 5; ++f) tracker.update(frame(f));
  for (int f = 5; f < 8; ++f) tracker.update(empty(f));
  const Track track = tracker.update(frame(8))[0];
  EXPECT_EQ(track.state, TrackState::Tracked) << track.above_chance;
  EXPECT_LT(error(track, pose_at(8)), 0.03);
}

// Another thread looks for the lost part while update() goes on with new images.
TEST_F(TrackerTest, FindsALostPartAgainInAnotherThread) {
  TemplateOptions templates;
  templates.distance_min_m = 0.36;
  templates.distance_max_m = 0.5;
  sets = {build_templates(block, templates, *backend)};
  TrackOptions options;
  options.doubtful_frames = 0;
  Tracker tracker(sets, camera, *backend, options);
  const int id = tracker.add(0, pose_at(0));
  tracker.update(frame(0));
  ASSERT_EQ(tracker.update(empty(1))[0].state, TrackState::Lost);
  const TrackFrame seen = frame(2);
  std::atomic<int> found = -1;
  std::thread searching([&] {
    const std::unique_ptr<Backend> own = make_backend("cpu");
    found = tracker.search(seen, *own);
  });
  int frames = 0;
  while (found < 0) {
    tracker.update({seen.image, 0.2 + 0.001 * ++frames});
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
  searching.join();
  EXPECT_EQ(found, 1);
  const Track track = tracker.update({seen.image, 1e6})[0];
  EXPECT_EQ(track.id, id);
  EXPECT_EQ(track.state, TrackState::Tracked);
  EXPECT_LT(error(track, pose_at(2)), 0.03);
  EXPECT_EQ(tracker.search({seen.image, 2e6}, *backend), 0) << "nothing is missing";
  EXPECT_EQ(tracker.tracks().size(), 1u);
}

// Where the limit is over, an update is as one that registers nothing.
TEST_F(TrackerTest, TheLimitOfAnUpdateEndsTheRegistrationOfDoubtfulPoses) {
  TrackOptions no_registration;
  no_registration.register_doubtful = false;
  bool has_registered = false;
  for (const double scale : {1.0, 2.0, 3.0, 4.0}) {
    Vector6d off;
    off << 0.004, -0.003, 0.007, 0.08, -0.06, 0.07;
    const auto updated = [&](const TrackOptions& options, const TimeLimit& limit) {
      Tracker tracker(sets, camera, *backend, options);
      tracker.add(0, retract(pose_at(0), scale * off));
      return tracker.update(frame(0), limit)[0];
    };
    const Track plain = updated(no_registration, {}), whole = updated({}, {});
    for (const TimeLimit& limit : {TimeLimit{{}, [] { return true; }}, TimeLimit::after(0)}) {
      const Track limited = updated({}, limit);
      EXPECT_EQ(limited.state, plain.state) << scale;
      EXPECT_EQ(limited.world_from_object.translation_m, plain.world_from_object.translation_m);
      EXPECT_EQ(limited.above_chance, plain.above_chance) << scale;
    }
    has_registered |= plain.state != TrackState::Tracked && whole.state == TrackState::Tracked;
  }
  EXPECT_TRUE(has_registered) << "no pose needs the registration";
}

TEST_F(TrackerTest, ASearchEndsWithItsLimit) {
  TemplateOptions templates;
  templates.distance_min_m = 0.39;
  templates.distance_max_m = 0.41;
  sets = {build_templates(block, templates, *backend)};
  Tracker tracker(sets, camera, *backend);
  EXPECT_EQ(tracker.search(frame(0), *backend, {{}, [] { return true; }}), 0);
}

// The nearer part covers most of the other one, whose edges are looked for where they can be seen.
TEST_F(TrackerTest, PartsHideEachOther) {
  const auto far_pose = [](int f) {
    return Se3{so3_exp({0.5, -0.4, 0.3}), {0.01 + 0.0002 * f, 0, 0.5}};
  };
  const auto near_pose = [](int f) {
    return Se3{so3_exp({0.2, 0.5, 0.1}), {-0.09 + 0.004 * f, 0.012, 0.35}};
  };
  Tracker tracker(sets, camera, *backend);
  tracker.add(0, far_pose(0));
  tracker.add(0, near_pose(0));
  for (int f = 0; f < 36; ++f) {
    Image image = flat_of(far_pose(f));
    const Image near = flat_of(near_pose(f));
    for (std::size_t i = 0; i < image.pixels.size(); ++i)
      if (near.pixels[i] != 35) image.pixels[i] = near.pixels[i];
    const std::vector<Track>& tracks =
        tracker.update({std::make_shared<const Image>(image), 0.1 * f});
    EXPECT_LT(error(tracks[0], far_pose(f)), 0.08) << f << " " << to_string(tracks[0].state);
    EXPECT_LT(error(tracks[1], near_pose(f)), 0.04) << f;
    EXPECT_NE(tracks[1].state, TrackState::Lost) << f;
  }
}

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

TEST_F(TrackerTest, RefusesWhatIsNoNextFrame) {
  Tracker tracker(sets, camera, *backend);
  tracker.add(0, pose_at(0));
  tracker.update(frame(3));
  EXPECT_THROW(tracker.update(frame(3)), InputError) << "not later";
  EXPECT_THROW(tracker.update({nullptr, 1}), LogicError);
  EXPECT_THROW(tracker.update({frame(4).image, NAN}), InputError);
  const auto small = std::make_shared<const Image>(Image{16, 16, std::vector<std::uint8_t>(256)});
  EXPECT_THROW(tracker.update({small, 1}), InputError);
  EXPECT_EQ(tracker.update(frame(4))[0].state, TrackState::Tracked) << "as before the errors";
}

TEST_F(TrackerTest, RefusesUnknownObjectsAndIds) {
  Tracker tracker(sets, camera, *backend);
  EXPECT_THROW(tracker.add(1, pose_at(0)), LogicError);
  EXPECT_THROW(tracker.add(0, {Eigen::Quaterniond::Identity(), {NAN, 0, 1}}), LogicError);
  EXPECT_THROW(tracker.remove(1), LogicError);
  const int id = tracker.add(0, pose_at(0));
  tracker.remove(id);
  EXPECT_TRUE(tracker.tracks().empty());
  EXPECT_THROW(tracker.search(frame(0), *backend), LogicError) << "no templates";
  TrackOptions options;
  options.search_px = 1000;
  EXPECT_THROW(Tracker(sets, camera, *backend, options), InputError);
}

// The rendered image of a part with light, noise and a printed board.
TEST_F(TrackerTest, FollowsARenderedPart) {
  MovingSceneOptions moving;
  moving.render.width = 320;
  moving.render.height = 240;
  moving.render.focal_px = 420;
  moving.render.supersampling = 1;
  moving.render.shadows = false;
  moving.frames = 12;
  const MovingScene scene = make_moving_scene(block, moving, pool);
  Tracker tracker(sets, scene.camera, *backend);
  tracker.add(0, scene.frames[0].camera_from_object);
  for (std::size_t f = 0; f < scene.frames.size(); ++f) {
    const Track track =
        tracker.update({std::make_shared<const Image>(scene.frames[f].image), double(f)})[0];
    EXPECT_EQ(track.state, TrackState::Tracked) << f;
    EXPECT_LT(error(track, scene.frames[f].camera_from_object), 0.05) << f;
  }
}

}  // namespace
}  // namespace edgescout
