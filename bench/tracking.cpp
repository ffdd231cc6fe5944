// Tracking over rendered sequences of known poses.
//
//   edgescout_bench_tracking [--frames N] [--seed N] [--part NAME | --mesh-mm FILE]
//   [--points N] [--no-registration] [--no-depth] [--noise M]
//
// Prints two rows for each part and kind of motion, without and with the depth image of a sensor
// with errors and a third of the part's pixels missing: the frames that are tracked, doubtful and
// lost; of the tracked ones those that are wrong (MSSD above a tenth of the diameter); errors of
// the right ones, as MSSD and of the part's centre along the camera's axis; the time of an update.
// A lost part is searched for in every frame: how many frames and seconds of search from the loss,
// or from the first frame in which half of the part is visible, until it is tracked again.
#include <algorithm>
#include <chrono>
#include <cstdio>
#include <string>
#include <vector>

#include "bench/arguments.h"
#include "host/core/pose_error.h"
#include "host/core/quantile.h"
#include "host/core/stopwatch.h"
#include "host/experiments/moving_scene.h"
#include "host/io/mesh.h"
#include "host/render/parts.h"
#include "host/track/tracker.h"
#include "kernels/thread_pool.h"

namespace {

using namespace edgescout;

struct Arguments {
  int frames = 60, seed = 1, points = TrackOptions{}.max_points;
  std::string part, mesh_mm;
  bool no_registration = false, no_depth = false;
  double noise_m = DepthNoise{}.at_one_metre_m;  // that the tracker is told
};

struct Motion {
  const char* name;
  double speed_px, turn_rad;
  int hidden_frames = 0;
  double jump_px = 0;
  double hand_covers = 0;
};
constexpr Motion motions[] = {{"slow", 2, 0.01},
                              {"medium", 6, 0.03},
                              {"fast", 15, 0.06},
                              {"very fast", 30, 0.1},
                              {"hidden 8 frames", 3, 0.01, 8},
                              {"jump of 40 px", 3, 0.01, 0, 40},
                              {"a hand covers a half", 3, 0.01, 0, 0, 0.5},
                              {"a hand covers 0.8", 3, 0.01, 0, 0, 0.8}};

MovingSceneOptions options_of(const Motion& motion, const Arguments& a) {
  MovingSceneOptions options;
  options.render.seed = unsigned(a.seed);
  options.render.width = 640;
  options.render.height = 480;
  options.render.focal_px = 800;
  options.render.supersampling = 1;
  options.render.shadows = false;  // they take most of the time
  options.render.depth.on = !a.no_depth;
  options.render.depth.holes = 1.0 / 3;
  options.frames = a.frames;
  options.speed_px = motion.speed_px;
  options.turn_rad = motion.turn_rad;
  options.hidden_frames = motion.hidden_frames;
  options.jump_frame = motion.jump_px > 0 ? a.frames / 2 : -1;
  options.jump_px = motion.jump_px;
  options.hand_covers = motion.hand_covers;
  return options;
}

std::vector<Object> parts_of(const Arguments& a) {
  if (!a.mesh_mm.empty()) return {{1, load_mesh(a.mesh_mm, LengthUnit::Millimetre), {}}};
  std::vector<Object> parts;
  for (const std::string& name : a.part.empty() ? part_names() : std::vector{a.part})
    parts.push_back(make_part(name));
  return parts;
}

struct Outcome {
  int tracked = 0, doubtful = 0, lost = 0, wrong = 0;
  std::vector<double> errors, axis_errors_mm, above_chance_right, above_chance_wrong, update_ms;
  int losses = 0, found_again = 0, frames_to_find = 0;
  double search_seconds = 0;
};

TemplateSet set_of(const Object& part, const MovingScene& scene, Backend& backend) {
  const double distance_m =
      (scene.frames[0].camera_from_object * make_edge_model(part.mesh).center_m).norm();
  TemplateOptions templates;
  templates.distance_min_m = 0.9 * distance_m;
  templates.distance_max_m = 1.1 * distance_m;
  return build_templates(part, templates, backend);
}

TrackFrame frame_of(const MovingScene& scene, std::size_t f, const DepthNoise* noise) {
  TrackFrame frame{std::make_shared<const Image>(scene.frames[f].image), double(f)};
  if (noise)
    frame.depth =
        std::make_shared<const MeasuredDepth>(MeasuredDepth{scene.frames[f].depth, *noise});
  return frame;
}

double axis_error_mm(const Se3& found, const Se3& truth, const Object& part) {
  const Eigen::Vector3d center_m = 0.5 * (part.mesh.box_min_m + part.mesh.box_max_m);
  return 1000 * std::abs((found * center_m).z() - (truth * center_m).z());
}

// `noise` null: without depth.
Outcome follow(const Object& part, const MovingScene& scene, const Arguments& a,
               const DepthNoise* noise) {
  const std::unique_ptr<Backend> backend = make_backend("cpu");
  const std::vector<TemplateSet> sets{set_of(part, scene, *backend)};
  TrackOptions options;
  options.max_points = a.points;
  options.register_doubtful = !a.no_registration;
  Tracker tracker(sets, scene.camera, *backend, options);
  tracker.add(0, scene.frames[0].camera_from_object);
  Outcome outcome;
  bool was_lost = false;
  for (std::size_t f = 0; f < scene.frames.size(); ++f) {
    const TrackFrame frame = frame_of(scene, f, noise);
    auto begin = std::chrono::steady_clock::now();
    if (was_lost && scene.frames[f].visible > 0.5) {
      tracker.search(frame, *backend);
      outcome.search_seconds += seconds_since(begin);
      ++outcome.frames_to_find;
    }
    begin = std::chrono::steady_clock::now();
    const Track track = tracker.update(frame)[0];
    outcome.update_ms.push_back(1000 * seconds_since(begin));
    outcome.losses += track.state == TrackState::Lost && !was_lost;
    outcome.found_again += track.state == TrackState::Tracked && was_lost;
    was_lost = track.state == TrackState::Lost || (was_lost && track.state != TrackState::Tracked);
    const double error = mssd_m(track.world_from_object, scene.frames[f].camera_from_object, part) /
                         part.mesh.diameter_m;
    const bool is_right = error < 0.1;
    (is_right ? outcome.above_chance_right : outcome.above_chance_wrong)
        .push_back(track.above_chance);
    ++(track.state == TrackState::Tracked    ? outcome.tracked
       : track.state == TrackState::Doubtful ? outcome.doubtful
                                             : outcome.lost);
    if (track.state != TrackState::Tracked) continue;
    outcome.wrong += !is_right;
    if (!is_right) continue;
    outcome.errors.push_back(error);
    outcome.axis_errors_mm.push_back(
        axis_error_mm(track.world_from_object, scene.frames[f].camera_from_object, part));
  }
  return outcome;
}

void report(const std::string& part, const Motion& motion, bool has_depth, const Outcome& o) {
  std::printf(
      "| %s | %s | %s | %d | %d | %d | %d | %.2f | %.2f | %.2f | %.2f | %.2f | %.2f | %.2f | %.2f "
      "| %d | %d | %d | %.1f |\n",
      part.c_str(), motion.name, has_depth ? "yes" : "no", o.tracked, o.doubtful, o.lost, o.wrong,
      100 * quantile(o.errors, 0.5), 100 * quantile(o.errors, 0.95),
      quantile(o.axis_errors_mm, 0.5), quantile(o.axis_errors_mm, 0.95),
      quantile(o.above_chance_right, 0.05), quantile(o.above_chance_wrong, 0.95),
      quantile(o.update_ms, 0.5), quantile(o.update_ms, 0.99), o.losses, o.found_again,
      o.frames_to_find, o.search_seconds);
  std::fflush(stdout);
}

}  // namespace

int main(int argc, char** argv) try {
  Arguments a;
  bench::read_arguments(argc, argv,
                        {{"--frames", &a.frames},
                         {"--seed", &a.seed},
                         {"--points", &a.points},
                         {"--part", &a.part},
                         {"--mesh-mm", &a.mesh_mm},
                         {"--no-registration", &a.no_registration},
                         {"--no-depth", &a.no_depth},
                         {"--noise", &a.noise_m}});
  std::puts(
      "| part | motion | depth | tracked | doubtful | lost | wrong of tracked | error, median, % "
      "of the "
      "diameter | 95 % | along the axis, median, mm | 95 % | above chance, 5 % of right | 95 % of "
      "wrong | ms, median | 99 % | losses | "
      "found again | frames searched | s of search |\n"
      "|---|---|---|---|---|---|---|---|---|---|---|---|---|---|---|---|---|---|---|");
  ThreadPool pool(0);
  const DepthNoise noise{DepthNoise{}.floor_m, a.noise_m};
  for (const Object& part : parts_of(a))
    for (const Motion& motion : motions) {
      const MovingScene scene = make_moving_scene(part, options_of(motion, a), pool);
      report(part.mesh.name, motion, false, follow(part, scene, a, nullptr));
      if (!a.no_depth) report(part.mesh.name, motion, true, follow(part, scene, a, &noise));
    }
} catch (const std::exception& error) {
  std::fprintf(stderr, "%s\n", error.what());
  return 2;
}
