// Registration from given starts, against the original D2CO implementation's results on the same
// ones.
//
//   edgescout_bench_registration FOLDER [--device D] [--every N] [--search RAD] [--views 1|3]
//   [--truth]
//   [--lambda L]
//
// FOLDER is the set (host/experiments/recorded_starts.h). --truth: from every instance's true pose
// instead. Prints the rate of correct registrations (below 0.1 rad and 5 mm) by level, quantiles of
// the errors and the time of one registration.
#include <algorithm>
#include <chrono>
#include <cstdio>
#include <iostream>
#include <map>

#include "bench/arguments.h"
#include "host/core/pose_error.h"
#include "host/core/stopwatch.h"
#include "host/experiments/recorded_starts.h"
#include "host/register/refine.h"
#include "kernels/error.h"

namespace {

using namespace edgescout;
using Clock = std::chrono::steady_clock;

struct Arguments {
  std::string folder, device = "cpu";
  int every = 1, views = 1;
  double search_rad = 0.3, lambda = TensorOptions{}.lambda_px_per_rad;
  bool truth = false;
};

Arguments parse(int argc, char** argv) {
  Arguments a;
  bench::read_arguments(argc, argv,
                        {{"FOLDER", &a.folder},
                         {"--device", &a.device},
                         {"--every", &a.every},
                         {"--views", &a.views},
                         {"--search", &a.search_rad},
                         {"--lambda", &a.lambda},
                         {"--truth", &a.truth}});
  if (a.views != 1 && a.views != 3)
    throw InputError("command line", "--views", std::to_string(a.views), "1 or 3");
  if (a.folder.empty())
    throw InputError("command line", "FOLDER", "nothing", "the folder of the starts");
  return a;
}

// At the truth one start an instance, of level 1.
std::vector<RecordedStart> starts_of(const Arguments& a, const KnownScene& scene) {
  if (!a.truth) return recorded_starts(a.folder, scene, a.every);
  std::vector<RecordedStart> starts;
  for (std::size_t i = 0; i < scene.instances.size(); ++i)
    starts.push_back({static_cast<int>(i), static_cast<int>(i), 1,
                      scene.images[0].camera_from_world * scene.instances[i].world_from_object});
  return starts;
}

struct Tally {
  std::map<int, std::pair<int, int>> levels;  // right ones and all
  std::vector<double> mm, rad;                // errors of those that are right; at the truth of all
  double seconds = 0;
  int count = 0;
};

double quantile(std::vector<double> values, double q) {
  if (values.empty()) return 0;
  std::ranges::sort(values);
  return values[std::min(values.size() - 1,
                         static_cast<std::size_t>(q * static_cast<double>(values.size())))];
}

void print(const Arguments& a, const Tally& tally) {
  int right = 0;
  for (const auto& [level, of_level] : tally.levels) {
    std::printf("level %d: %.1f %% of %d   ", level, 100.0 * of_level.first / of_level.second,
                of_level.second);
    right += of_level.first;
  }
  std::printf("all: %.1f %% of %d\n", 100.0 * right / tally.count, tally.count);
  std::printf(
      "%s: median %.2f mm %.4f rad, 95 %% %.2f mm %.4f rad, largest %.2f mm %.4f rad; %.2f ms a "
      "registration\n",
      a.truth ? "errors of all" : "errors of the correct ones", quantile(tally.mm, 0.5),
      quantile(tally.rad, 0.5), quantile(tally.mm, 0.95), quantile(tally.rad, 0.95),
      quantile(tally.mm, 1), quantile(tally.rad, 1), 1000 * tally.seconds / tally.count);
}

// All starts of one image, in one batch.
void register_in(const std::string& image, const Arguments& a, Backend& backend, Tally& tally) {
  const KnownScene scene = recorded_scene(a.folder, image, a.views - 1);
  TensorOptions tensor;
  tensor.lambda_px_per_rad = static_cast<float>(a.lambda);
  const std::vector<ObjectView> views =
      register_views(scene, edges_of(scene, backend), tensor, backend);
  std::vector<EdgeModel> models;
  for (const Object& object : scene.objects) models.push_back(make_edge_model(object.mesh));
  const std::vector<RecordedStart> starts = starts_of(a, scene);
  const Se3& camera_from_world = scene.images[0].camera_from_world;
  std::vector<ObjectPose> poses;
  for (const RecordedStart& start : starts)
    poses.push_back({scene.instances[static_cast<std::size_t>(start.instance)].object,
                     inverse(camera_from_world) * start.camera_from_object});
  RefineOptions options;
  options.search.rotation_rad = a.search_rad;
  const auto begin = Clock::now();
  const std::vector<PoseEstimate> refined = refine_poses({models, views, backend}, poses, options);
  tally.seconds += seconds_since(begin);
  for (std::size_t i = 0; i < starts.size(); ++i, ++tally.count) {
    const KnownInstance& instance = scene.instances[static_cast<std::size_t>(starts[i].instance)];
    const PoseError error =
        pose_error(refined[i].world_from_object, instance.world_from_object,
                   scene.objects[static_cast<std::size_t>(instance.object)].symmetries);
    auto& [right, all] = tally.levels[starts[i].level];
    right += error.passes();
    ++all;
    if (!error.passes() && !a.truth) continue;
    tally.mm.push_back(1000 * error.distance_m);
    tally.rad.push_back(error.angle_rad);
  }
}

int run(int argc, char** argv) {
  const Arguments a = parse(argc, argv);
  const std::unique_ptr<Backend> backend = make_backend(a.device);
  Tally tally;
  for (const std::string& image : recorded_images(a.folder))
    if (other_views(a.folder, image) >= a.views - 1) register_in(image, a, *backend, tally);
  if (tally.count == 0)
    throw InputError(a.folder, "starts", "none", "an image with starts and as many views");
  print(a, tally);
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  try {
    return run(argc, argv);
  } catch (const std::exception& error) {
    std::cerr << "edgescout_bench_registration: error: " << error.what() << "\n";
    return 2;
  }
}
