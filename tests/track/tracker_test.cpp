#include "host/track/tracker.h"

#include <gtest/gtest.h>

#include <atomic>
#include <thread>

#include "host/experiments/moving_scene.h"
#include "kernels/error.h"
#include "tests/track/tracked_block.h"

namespace edgescout::test {
namespace {

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
}  // namespace edgescout::test
