// Tracking over rendered sequences of known poses.
#include "host/track/tracker.h"

#include <gtest/gtest.h>

#include "host/core/pose_error.h"
#include "host/experiments/moving_scene.h"
#include "host/render/parts.h"
#include "kernels/error.h"
#include "kernels/thread_pool.h"

namespace edgescout {
namespace {

MovingSceneOptions small_sequence(int frames) {
  MovingSceneOptions options;
  options.render.width = 320;
  options.render.height = 240;
  options.render.focal_px = 420;
  options.render.supersampling = 1;
  options.render.clutter = 1;
  options.frames = frames;
  return options;
}

class TrackerTest : public testing::Test {
 protected:
  void render(const MovingSceneOptions& options) {
    ThreadPool pool(2);
    scene = make_moving_scene(part, options, pool);
  }
  void follow(Tracker& tracker) {
    for (std::size_t f = 0; f < scene.frames.size(); ++f)
      followed.push_back(tracker.update(frame(f)));
  }
  TrackFrame frame(std::size_t f) const {
    return {std::make_shared<const Image>(scene.frames[f].image), 0.1 * double(f)};
  }
  double error_of_diameter(std::size_t f) const {
    return mssd_m(followed[f][0].world_from_object, scene.frames[f].camera_from_object, part) /
           part.mesh.diameter_m;
  }

  Object part = make_part("l_bracket");
  std::vector<TemplateSet> sets{{1, part.symmetries, {}, make_edge_model(part.mesh), {}}};
  std::unique_ptr<Backend> backend = make_backend("cpu");
  MovingScene scene;
  std::vector<std::vector<Track>> followed;
};

TEST_F(TrackerTest, FollowsAPartThatMovesAndTurns) {
  render(small_sequence(30));
  Tracker tracker(sets, scene.camera, *backend);
  tracker.add(0, scene.frames[0].camera_from_object);
  follow(tracker);
  for (std::size_t f = 0; f < followed.size(); ++f) {
    EXPECT_EQ(followed[f][0].state, TrackState::Tracked) << f;
    EXPECT_LT(error_of_diameter(f), 0.03) << f << " above chance " << followed[f][0].above_chance;
  }
}

}  // namespace
}  // namespace edgescout
