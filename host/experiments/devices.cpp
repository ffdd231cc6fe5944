#include "host/experiments/devices.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <memory>
#include <optional>

#include "host/detect/coarse_scan.h"
#include "host/experiments/decision.h"
#include "host/experiments/known_scene.h"
#include "host/experiments/rates.h"
#include "host/experiments/settings.h"
#include "host/experiments/trials.h"
#include "host/pipeline.h"
#include "host/register/refine.h"
#include "host/render/parts.h"
#include "kernels/copy_speed.h"
#include "kernels/device_memory.h"
#include "kernels/error.h"

namespace edgescout {

namespace {

using Clock = std::chrono::steady_clock;
double ms_since(Clock::time_point start) {
  return std::chrono::duration<double, std::milli>(Clock::now() - start).count();
}

constexpr int PARTS = 5, POSES = 40;
constexpr double ENOUGH_MS = 120000;  // a device that used more gets no further repetition
constexpr int LEAST_REPETITIONS = 3;

// The input of the stages, made once on the CPU for all devices.
struct Work {
  KnownScene scene;
  std::vector<TemplateSet> sets;
  std::vector<EdgeModel> models;
  std::vector<ObjectPose> starts, truths;  // of registration and of scoring, in the camera frame
  DecisionWork decision;                   // of the next view
  PipelineOptions options;                 // of the whole pipeline
};

KnownScene make_scene_of_parts(const DevicesOptions& o, ThreadPool& pool) {
  ExperimentSettings settings;
  settings.image_scale = o.image_scale;
  RenderOptions render = single_image_options(settings, 0);
  render.seed = o.seed;
  render.objects = PARTS;
  render.clutter = 1;
  render.pile = 0.3;
  KnownScene scene = rendered_scene("devices", {make_part("bearing_block")}, render, pool);
  if (scene.instances.empty())
    throw InputError("bench devices", "seed", std::to_string(o.seed),
                     "one whose parts can be seen");
  return scene;
}

// Distances left at 0: those of the parts in the image, and 15 % more at both ends.
TemplateOptions with_distances_in(const KnownScene& scene, TemplateOptions templates) {
  double nearest_m = 1e9, farthest_m = 0;
  for (const KnownInstance& instance : scene.instances) {
    const double distance_m =
        (scene.images[0].camera_from_world * instance.world_from_object).translation_m.norm();
    nearest_m = std::min(nearest_m, distance_m);
    farthest_m = std::max(farthest_m, distance_m);
  }
  if (templates.distance_min_m == 0) templates.distance_min_m = 0.85 * nearest_m;
  if (templates.distance_max_m == 0) templates.distance_max_m = 1.15 * farthest_m;
  return templates;
}

Work make_work(const DevicesOptions& o, Backend& cpu) {
  Work work;
  work.options = o.pipeline;
  work.scene = make_scene_of_parts(o, cpu.threads());
  work.sets.push_back(
      build_templates(work.scene.objects[0], with_distances_in(work.scene, o.templates), cpu));
  work.models = models_of(work.sets);
  work.decision = make_decision_work(decision_bin(cpu.threads()), {}, cpu);
  const int each = (POSES + static_cast<int>(work.scene.instances.size()) - 1) /
                   static_cast<int>(work.scene.instances.size());
  for (const Start& start : starts_around(work.scene, each, o.seed)) {
    if (static_cast<int>(work.starts.size()) == POSES) break;
    work.starts.push_back({0, start.camera_from_object});
    work.truths.push_back({0, work.scene.images[0].camera_from_world *
                                  work.scene.instances[start.instance].world_from_object});
  }
  return work;
}

// Measures the stages, one after the other on one image.
class Stages {
 public:
  Stages(std::vector<StageSamples>& samples, const Backend& backend)
      : samples_(samples), backend_(backend) {}
  template <typename Stage>
  auto time(const char* name, const Stage& stage) {
    const DeviceWork before = backend_.device_work();
    const Clock::time_point start = Clock::now();
    auto result = stage();
    add({name, ms_since(start) / 1000, backend_.device_work() - before});
    return result;
  }
  void add(const StageSeconds& stage) {
    if (next_ == samples_.size()) samples_.push_back({stage.name, {}, {}, {}});
    StageSamples& measured = samples_[next_++];
    measured.device = stage.device;
    measured.ms.push_back(1000 * stage.seconds);
    if (const std::optional<double> host = stage.host_seconds())
      measured.host_ms.push_back(1000 * *host);
  }

 private:
  std::vector<StageSamples>& samples_;
  const Backend& backend_;
  std::size_t next_ = 0;
};

void run_stages(const Work& work, Backend& backend, std::vector<StageSamples>& samples) {
  Stages stages(samples, backend);
  std::vector<StageSeconds> parts;  // of the image prepared last
  const auto prepare = [&] {
    const KnownImage& image = work.scene.images[0];
    parts.clear();
    return prepare_view(image.image, image.camera, Se3{}, backend, work.options, &parts);
  };
  const ObjectView prepared = stages.time("edges", prepare);
  const ObjectView view = stages.time("tensors", [&] {
    ObjectView with_tensors = prepared;
    add_tensors(with_tensors, work.sets, backend, work.options.tensor);
    return with_tensors;
  });
  const Scene scene{work.models, {&view, 1}, backend};
  const DetectOptions& detect = work.options.detect;
  stages.time("scan", [&] { return coarse_scan(work.sets[0], view, backend, detect.scan); });
  stages.time("registration", [&] { return refine_poses(scene, work.starts, detect.refine); });
  FeatureOptions features;
  features.score = detect.refine.score;
  stages.time("scoring", [&] { return pooled_features(scene, work.truths, features); });
  stages.time("next view", [&] { return decide(work.decision, backend); });
  const Detections found = stages.time(
      IMAGE_TO_POSES, [&] { return detect_objects(prepare(), work.sets, backend, work.options); });
  parts.insert(parts.end(), found.stages.begin(), found.stages.end());
  for (StageSeconds& part : parts) {
    part.name = std::string(IMAGE_TO_POSES) + ": " + part.name;
    stages.add(part);
  }
}

// A device that is measured.
struct Runner {
  DeviceTimes times;
  std::unique_ptr<Backend> backend;
  double used_ms = 0;
};

std::vector<Runner> make_runners(const DevicesOptions& options) {
  const std::vector<DeviceInfo> known = vulkan_devices();
  std::vector<std::string> choices{"cpu"};
  if (options.devices.empty())
    for (const DeviceInfo& device : known)
      choices.push_back("vulkan:" + std::to_string(device.index));
  for (const std::string& choice : options.devices)
    if (std::ranges::find(choices, choice) == choices.end()) choices.push_back(choice);
  std::vector<Runner> runners;
  for (const std::string& choice : choices) {
    Runner& runner = runners.emplace_back();
    runner.backend = make_backend(choice, {.time_kernels = true});
    runner.times.choice = choice;
    runner.times.name = runner.backend->name();
    for (const DeviceInfo& device : known) {
      if (!runner.times.name.starts_with("vulkan:" + std::to_string(device.index) + " ")) continue;
      runner.times.driver = device.driver;
      runner.times.is_software = !device.hardware;
    }
  }
  return runners;
}

// The first image on a device is not timed (memory pages, the driver's compiler). Its peak memory
// is reported.
void warm_up(Runner& runner, const Work& work) {
  forget_peak_memory();
  forget_peak_device_memory();
  std::vector<StageSamples> ignored;
  run_stages(work, *runner.backend, ignored);
  runner.times.peak_host_bytes = peak_memory_bytes();
  runner.times.peak_device_bytes = runner.backend->is_gpu() ? peak_device_memory_bytes() : 0;
}

void describe(const Work& work, DevicesReport& report) {
  report.width = work.scene.images[0].camera.width;
  report.height = work.scene.images[0].camera.height;
  report.instances = static_cast<int>(work.scene.instances.size());
  report.poses = static_cast<int>(work.starts.size());
  const TemplateSet& set = work.sets[0];
  report.templates = set.views.size() * static_cast<std::size_t>(set.options.in_plane_steps) *
                     template_distances_m(set.options).size();
}

void time_kernels(Runner& runner, int repetitions) {
  runner.times.copy_bytes_per_s = copy_bytes_per_s(runner.times.choice);
  for (const bench::Case& timed : bench::make_cases(*runner.backend, bench::Size::full))
    runner.times.kernels.push_back(bench::measure(*runner.backend, timed, repetitions));
}

}  // namespace

void DevicesOptions::validate() const {
  const auto require = [](bool holds, const char* field, double found, const char* expected) {
    if (!holds) throw InputError("bench devices", field, number_text(found), expected);
  };
  require(repetitions >= LEAST_REPETITIONS && repetitions <= 1000, "repetitions", repetitions,
          "3 to 1000");
  templates.validate();
  pipeline.validate();
  require(image_scale >= 0.1 && image_scale <= 4, "image_scale", image_scale, "0.1 to 4");
}

double StageSamples::median_ms() const { return median(ms); }

DevicesReport time_devices(const DevicesOptions& options,
                           const std::function<void(std::size_t, std::size_t)>& progress) {
  options.validate();
  DevicesReport report;
  report.options = options;
  report.load = machine_load();
  report.warnings = warnings_of(report.load);
  std::vector<Runner> runners = make_runners(options);
  const Work work = make_work(options, *runners[0].backend);
  describe(work, report);
  for (Runner& runner : runners) {
    if (runner.times.is_software)
      report.warnings.push_back(runner.times.name +
                                " is a software device: its times say nothing of a graphics card");
    warm_up(runner, work);
  }
  // The devices take turns, so that changes on the machine affect all of them alike.
  for (int i = 0; i < options.repetitions; ++i) {
    for (Runner& runner : runners) {
      if (i >= LEAST_REPETITIONS && runner.used_ms > ENOUGH_MS) continue;
      const Clock::time_point start = Clock::now();
      run_stages(work, *runner.backend, runner.times.stages);
      runner.used_ms += ms_since(start);
    }
    if (progress)
      progress(static_cast<std::size_t>(i) + 1, static_cast<std::size_t>(options.repetitions));
  }
  for (Runner& runner : runners) {
    if (options.kernels) time_kernels(runner, options.repetitions);
    report.devices.push_back(std::move(runner.times));
  }
  report.load_at_end = machine_load();
  for (std::string& warning : warnings_at_end(report.load_at_end))
    report.warnings.push_back(std::move(warning));
  return report;
}

}  // namespace edgescout
