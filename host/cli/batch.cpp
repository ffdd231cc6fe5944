#include "host/cli/batch.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <future>
#include <iostream>

#include "host/cli/depth_warnings.h"
#include "host/cli/progress.h"
#include "host/cli/shard_file.h"
#include "host/cli/view_results.h"
#include "host/cli/wanted_objects.h"
#include "host/core/log.h"
#include "host/core/stopwatch.h"
#include "host/detect/depth_check.h"
#include "host/io/files.h"
#include "host/io/image.h"
#include "kernels/error.h"
#include "kernels/thread_pool.h"

namespace edgescout {

namespace {

using Clock = std::chrono::steady_clock;

BatchSettings settings_of(std::span<const TemplateSet> sets, std::span<const InputImage> images,
                          const BatchOptions& options) {
  BatchSettings settings{options.settings, {}};
  for (auto& setting : settings_of(sets)) settings.common.push_back(std::move(setting));
  settings.camera = given_camera(options.camera, images);
  return settings;
}

// The images of one detection: one image, or all views of a scene.
struct Group {
  std::vector<const InputImage*> images;
  std::string views;  // the value of the setting "views"
};

std::vector<Group> group_images(std::span<const InputImage> images, bool joint,
                                const BatchSettings& settings) {
  std::vector<Group> groups;
  for (const std::span<const InputImage> members : groups_of(images, joint)) {
    Group& group = groups.emplace_back();
    for (const InputImage& image : members) group.images.push_back(&image);
    group.views = joint ? settings.jointly(group.images) : "alone";
  }
  return groups;
}

struct PreparedGroup {
  std::vector<PreparedView> views;    // one per image of the group
  std::vector<std::string> failures;  // one per image; empty if the image is good
};

// Decodes and undistorts images. Also finds their edges, on its own CPU backend, unless the
// detector's backend does. It may run on another thread while the detector works on the group
// before.
class Preparer {
 public:
  Preparer(const BatchOptions& options, const std::optional<Camera>& camera, bool finds_edges)
      : options_(options),
        camera_(camera),
        depth_(options.depth),
        backend_(finds_edges ? make_cpu_backend(1) : nullptr) {}
  PreparedGroup prepare(const Group& group) {
    PreparedGroup prepared;
    for (const InputImage* input : group.images) {
      try {
        prepared.views.push_back(prepare_one(*input));
        prepared.failures.emplace_back();
      } catch (const InputError& error) {
        prepared.views.emplace_back();
        prepared.failures.emplace_back(error.what());
      }
    }
    return prepared;
  }

 private:
  PreparedView prepare_one(const InputImage& input) {
    const auto start = Clock::now();
    const Image image = read_image(input);
    PreparedView prepared{{}, {{"decode", seconds_since(start)}}};
    const Camera camera = camera_of(input, image.width, image.height,
                                    {camera_, options_.camera.file, options_.scale_camera});
    const Se3 camera_from_world = options_.joint ? *input.camera_from_world : Se3{};
    prepared.view = naming(input, [&] {
      return backend_ ? prepare_view(image, camera, camera_from_world, *backend_, options_.pipeline,
                                     &prepared.stages)
                      : undistort(image, camera, camera_from_world, prepared.stages);
    });
    prepared.view.depth = depth_.read(input, camera, depth_threads_);
    return prepared;
  }

  static ObjectView undistort(const Image& image, const Camera& camera,
                              const Se3& camera_from_world, std::vector<StageSeconds>& stages) {
    const auto start = Clock::now();
    ObjectView view = undistorted_view(image, camera, camera_from_world);
    stages.push_back({"undistort", seconds_since(start)});
    return view;
  }

  const BatchOptions& options_;
  const std::optional<Camera>& camera_;
  DepthReader depth_;
  ThreadPool depth_threads_{1};
  std::unique_ptr<Backend> backend_;  // null: edges are left to the detector
};

// Checks every image, also after one without a result: any existing result must be of this run.
bool is_done(const Group& group, const BatchOptions& options, const BatchSettings& settings) {
  bool all_done = true;
  for (const InputImage* input : group.images)
    all_done &= is_done(options.out, *input, settings.of(*input, group.views));
  return all_done;
}

// Detects in the prepared groups one after the other and writes their results. Finds the edges of
// views that have none.
class Detector {
 public:
  Detector(std::span<const InputImage> images, std::span<const TemplateSet> sets, Backend& backend,
           const BatchOptions& options, const BatchSettings& settings)
      : images_(images),
        sets_(sets),
        wanted_(sets),
        backend_(backend),
        options_(options),
        settings_(settings) {
    for (const TemplateSet& set : sets) models_.push_back(set.model);
    distances_ = surface_distances_m(sets);
    summary.verb = "detect";
    summary.by_scene = options.joint;
    summary.images = static_cast<int>(images.size());
  }
  void skip(const Group& group) {
    for (const InputImage* input : group.images) summary.finished.insert(input->name);
    summary.skipped += static_cast<int>(group.images.size());
  }
  void work_on(const Group& group, PreparedGroup prepared) {
    Group good{{}, group.views};
    std::vector<PreparedView> views;
    for (std::size_t i = 0; i < prepared.views.size(); ++i) {
      if (prepared.failures[i].empty())
        prepared.failures[i] = complete(*group.images[i], prepared.views[i]);
      if (!prepared.failures[i].empty()) {
        list_failure(*group.images[i], prepared.failures[i]);
        continue;
      }
      good.images.push_back(group.images[i]);
      views.push_back(std::move(prepared.views[i]));
    }
    if (views.empty()) return;
    for (std::size_t i = 0; i < views.size(); ++i)
      depth_warnings.check_view(good.images[i]->file.string(), views[i].view, distances_);
    const std::optional<Detections> found = detect(good, views);
    if (!found) return;
    if (views.size() == 1)
      depth_warnings.compare(good.images[0]->file.string(),
                             {models_, {&views[0].view, 1}, backend_}, found->detections);
    write(good, views, *found);
  }

  // If no image can be used, throws the error of the last one. Another shard may have good ones.
  void require_any_usable() const {
    if (!options_.shard && failed_ > 0 && failed_ == summary.images)
      throw InputError(last_failure_);
  }

  BatchSummary summary;
  DepthWarnings depth_warnings;

 private:
  // Returns why the view cannot have edges; nothing where it has them.
  std::string complete(const InputImage& input, PreparedView& prepared) {
    if (prepared.view.edges) return {};
    try {
      Stopwatch watch(prepared.stages, backend_);
      naming(input, [&] { add_edges(prepared.view, backend_, options_.pipeline.edges); });
      watch.lap("edges");
    } catch (const InputError& error) {
      return error.what();
    }
    return {};
  }

  // Returns nothing if the device cannot detect, as in an image too large for it.
  std::optional<Detections> detect(const Group& group, std::span<const PreparedView> prepared) {
    std::vector<ObjectView> views;
    for (std::size_t i = 0; i < prepared.size(); ++i) {
      views.push_back(prepared[i].view);
      views.back().camera_from_world = group.images[i]->camera_from_world.value_or(Se3{});
    }
    try {
      const std::span<const TemplateSet> sets = wanted_.sets_for(group.images);
      if (sets.empty()) return Detections{{}, stages_of(prepared)};
      PipelineOptions pipeline = options_.pipeline;
      pipeline.limit = limit_from_now(options_.max_seconds);
      Detections found = options_.joint ? detect_jointly(views, sets, backend_, pipeline)
                                        : detect_objects(views[0], sets, backend_, pipeline);
      wanted_.keep_most_probable(group.images, found.detections);
      const std::vector<StageSeconds> before = stages_of(prepared);
      found.stages.insert(found.stages.begin(), before.begin(), before.end());
      return found;
    } catch (const InputError& error) {
      for (const InputImage* input : group.images)
        list_failure(*input, input->file.string() + ": " + error.what());
      return std::nullopt;
    }
  }

  // InputError: a folder that cannot be written.
  void write(const Group& group, std::span<const PreparedView> views, const Detections& found) {
    require_writable_folder(options_.out);
    // Earlier results are removed only when there are new ones.
    if (!options_.resume && summary.finished.empty()) start_anew(options_.out, images_);
    for (const StageSeconds& stage : found.stages)
      summary.stage_seconds[stage.name] += stage.seconds;
    for (std::size_t i = 0; i < views.size(); ++i) {
      const InputImage& input = *group.images[i];
      const ObjectView& view = views[i].view;
      if (options_.overlays)
        save_overlay(input, {models_, {&view, 1}, backend_}, found.detections, options_.out);
      ImageResult result = result_of(input, view, found);
      result.settings = settings_.of(input, group.views);
      save_result(result, options_.out, input);
      summary.finished.insert(input.name);
      ++summary.done;
    }
  }

  ImageResult result_of(const InputImage& input, const ObjectView& view,
                        const Detections& found) const {
    ImageResult result = begin_result(input, view, found, backend_);
    for (const TemplateSet& set : sets_)
      result.objects.push_back({set.object_id, set.model.mesh.name});
    result.detections = found.detections;
    if (!options_.joint) carry_to_world(result);
    return result;
  }

  // If all images fail, the last failure is thrown, not logged.
  void list_failure(const InputImage& input, const std::string& message) {
    summary.failures[input.file.string()] = message;
    last_failure_ = message;
    if (++failed_ < summary.images || options_.shard) log(LogLevel::Warning, message);
  }

  std::span<const InputImage> images_;  // of the whole batch
  std::span<const TemplateSet> sets_;
  WantedObjects wanted_;
  Backend& backend_;
  const BatchOptions& options_;
  const BatchSettings& settings_;
  std::vector<EdgeModel> models_;
  Range distances_;  // of surfaces, along the camera's axis
  int failed_ = 0;
  std::string last_failure_;
};

// Line segments are found on the processor in any case.
bool leaves_edges_to(const Backend& backend, const BatchOptions& options) {
  return options.pipeline.edges.method == EdgeMethod::Gradient &&
         options.edges_on_backend.value_or(backend.is_hardware());
}

void work_through(const std::vector<Group>& open, Preparer& preparer, Detector& detector) {
  Progress progress("detect", open.size(), std::cerr, stderr_is_terminal());
  std::future<PreparedGroup> next;
  if (!open.empty())
    next = std::async(std::launch::async, [&] { return preparer.prepare(open[0]); });
  for (std::size_t g = 0; g < open.size(); ++g) {
    PreparedGroup prepared = next.get();
    if (g + 1 < open.size())
      next = std::async(std::launch::async, [&, g] { return preparer.prepare(open[g + 1]); });
    detector.work_on(open[g], std::move(prepared));
    progress.step();
  }
}

// Existing results are checked before any work: a result of another run ends the batch.
std::vector<Group> open_groups(std::span<const InputImage> images, const BatchOptions& options,
                               const BatchSettings& settings, Detector& detector) {
  std::vector<Group> open;
  for (Group& group : group_images(images, options.joint, settings)) {
    if (options.resume && is_done(group, options, settings))
      detector.skip(group);
    else
      open.push_back(std::move(group));
  }
  return open;
}

}  // namespace

void require_joinable(std::span<const InputImage> images) {
  std::set<std::filesystem::path> places;
  for (const InputImage& image : images) {
    if (!image.camera_from_world)
      throw InputError(image.file.string(), "world pose", "none",
                       "cam_R_w2c and cam_t_w2c of every view with --joint");
    if (!places.insert(place_of(image)).second)
      throw InputError(image.file.string(), "view", "it twice", "every view once with --joint");
  }
}

BatchSummary run_batch(std::span<const InputImage> images, std::span<const TemplateSet> sets,
                       Backend& backend, const BatchOptions& options) {
  const auto start = Clock::now();
  if (options.joint) require_joinable(images);
  const BatchSettings settings = settings_of(sets, images, options);
  const std::vector<InputImage> own = images_of_shard(images, options.joint, options.shard);
  const ShardOfBatch shard(options.shard, {options.version, "detect", options.joint, 0, "", {}},
                           settings, images, own);
  shard.require_own(options.out);
  Preparer preparer(options, settings.camera, !leaves_edges_to(backend, options));
  Detector detector(own, sets, backend, options, settings);
  BatchSummary& summary = detector.summary;
  summary.templates = options.templates;
  const std::vector<Group> open = open_groups(own, options, settings, detector);
  require_writable_place(options.out);
  shard.save(options.out);
  warn_of_camera({settings.camera, options.camera.file, options.scale_camera});
  try {
    work_through(open, preparer, detector);
  } catch (const std::exception& error) {
    summary.error = error.what();
    summary.seconds = seconds_since(start);
    write_ended(own, summary, backend.name(), {options.out, options.thumbnails});
    throw;
  }
  detector.depth_warnings.log_warnings();
  detector.require_any_usable();
  summary.seconds = seconds_since(start);
  write_tables(own, summary, backend.name(), {options.out, options.thumbnails});
  return summary;
}

}  // namespace edgescout
