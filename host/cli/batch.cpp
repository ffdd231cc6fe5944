#include "host/cli/batch.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <future>
#include <iostream>

#include "host/cli/progress.h"
#include "host/cli/view_results.h"
#include "host/core/log.h"
#include "host/core/stopwatch.h"
#include "host/io/camera_file.h"
#include "host/io/files.h"
#include "host/io/image.h"
#include "kernels/error.h"

namespace edgescout {

namespace {

using Clock = std::chrono::steady_clock;

BatchSettings settings_of(std::span<const TemplateSet> sets, const BatchOptions& options) {
  BatchSettings settings{options.settings, {}};
  for (auto& setting : settings_of(sets)) settings.common.push_back(std::move(setting));
  if (!options.camera_file.empty()) settings.camera = load_camera(options.camera_file);
  return settings;
}

// The images that are detected together: one, or all views of a scene.
struct Group {
  std::vector<const InputImage*> images;
  std::string views;  // as settings tell them
};

std::vector<Group> group_images(std::span<const InputImage> images, bool joint,
                                const BatchSettings& settings) {
  std::vector<Group> groups;
  for (const std::span<const InputImage> together : groups_of(images, joint)) {
    Group& group = groups.emplace_back();
    for (const InputImage& image : together) group.images.push_back(&image);
    group.views = joint ? settings.jointly(group.images) : "alone";
  }
  return groups;
}

// What an image is before its device work: decoding and edges run on a thread and a CPU backend of
// their own, beside the device's work on the group before.
struct Prepared {
  std::vector<PreparedImage> images;
  std::vector<std::string> failures;  // empty where the image is good
};

class Preparer {
 public:
  Preparer(const BatchOptions& options, const std::optional<Camera>& camera)
      : options_(options), camera_(camera), backend_(make_cpu_backend(1)) {}
  Prepared prepare(const Group& group) {
    Prepared prepared;
    for (const InputImage* input : group.images) {
      try {
        prepared.images.push_back(prepare_one(*input));
        prepared.failures.emplace_back();
      } catch (const InputError& error) {
        prepared.images.emplace_back();
        prepared.failures.emplace_back(error.what());
      }
    }
    return prepared;
  }

 private:
  PreparedImage prepare_one(const InputImage& input) {
    const auto start = Clock::now();
    const Image image = load_image(input.file);
    const double decode_seconds = seconds_since(start);
    const Camera camera = camera_of(input, image.width, image.height,
                                    {camera_, options_.camera_file, options_.scale_camera});
    const Se3 from_world = options_.joint ? *input.camera_from_world : Se3{};
    PreparedImage prepared = naming(input, [&] {
      return prepare_image(image, camera, from_world, *backend_, options_.pipeline);
    });
    prepared.stages.insert(prepared.stages.begin(), {"decode", decode_seconds});
    return prepared;
  }

  const BatchOptions& options_;
  const std::optional<Camera>& camera_;
  std::unique_ptr<Backend> backend_;
};

ImageResult result_of(const InputImage& input, const PreparedImage& prepared,
                      const Detections& detections, std::span<const TemplateSet> sets,
                      const Backend& backend, bool joint) {
  ImageResult result = begin_result(input, prepared, detections, backend);
  for (const TemplateSet& set : sets)
    result.objects.push_back({set.object_id, set.model.mesh.name});
  result.detections = detections.detections;
  if (!joint) carry_to_world(result);
  return result;
}

// Each is judged, also after one that is missing: what is there must not be another run's.
bool is_done(const Group& group, const BatchOptions& options, const BatchSettings& settings) {
  bool all_done = true;
  for (const InputImage* input : group.images)
    all_done &= is_done(options.out, *input, settings.of(*input, group.views));
  return all_done;
}

// The batch behind the preparation: device work group by group.
class Detector {
 public:
  Detector(std::span<const InputImage> images, std::span<const TemplateSet> sets, Backend& backend,
           const BatchOptions& options, const BatchSettings& settings)
      : images_(images), sets_(sets), backend_(backend), options_(options), settings_(settings) {
    for (const TemplateSet& set : sets) models_.push_back(set.model);
  }
  void skip(const Group& group) {
    for (const InputImage* input : group.images) summary.finished.insert(input->name);
    summary.skipped += static_cast<int>(group.images.size());
  }
  void work_on(const Group& group, Prepared prepared) {
    Group good;
    std::vector<PreparedImage> usable;
    for (std::size_t i = 0; i < prepared.images.size(); ++i) {
      if (!prepared.failures[i].empty()) {
        list_failure(*group.images[i], prepared.failures[i]);
        continue;
      }
      good.images.push_back(group.images[i]);
      usable.push_back(std::move(prepared.images[i]));
    }
    if (usable.empty()) return;
    const std::optional<Detections> found = detect(good, usable);
    if (found) write(good, usable, *found, group.views);
  }

  // Where no image can be used, the last one's error is that of the request.
  void require_any_usable() const {
    if (failed_ > 0 && failed_ == summary.images) throw InputError(last_failure_);
  }

  BatchSummary summary;

 private:
  // Nothing where the device cannot: an image too large for it.
  std::optional<Detections> detect(const Group& group, std::span<const PreparedImage> images) {
    try {
      return options_.joint ? detect_jointly(images, sets_, backend_, options_.pipeline)
                            : detect_objects(images[0], sets_, backend_, options_.pipeline);
    } catch (const InputError& error) {
      for (const InputImage* input : group.images)
        list_failure(*input, input->file.string() + ": " + error.what());
      return std::nullopt;
    }
  }

  // InputError: a folder that cannot be written.
  void write(const Group& group, std::span<const PreparedImage> images, const Detections& found,
             const std::string& views) {
    require_writable_folder(options_.out);
    // Not before there is something in their place.
    if (!options_.resume && summary.finished.empty()) start_anew(options_.out, images_);
    for (const StageSeconds& stage : found.stages)
      summary.stage_seconds[stage.name] += stage.seconds;
    for (std::size_t i = 0; i < images.size(); ++i) {
      const InputImage& input = *group.images[i];
      if (options_.overlays) save_overlay(input, images[i], found, models_, backend_, options_.out);
      ImageResult result = result_of(input, images[i], found, sets_, backend_, options_.joint);
      result.settings = settings_.of(input, views);
      save_result(result, options_.out, input);
      summary.finished.insert(input.name);
      ++summary.done;
    }
  }

  // The last of a batch where all failed is thrown, not logged.
  void list_failure(const InputImage& input, const std::string& message) {
    summary.failures[input.file.string()] = message;
    last_failure_ = message;
    if (++failed_ < summary.images) log(LogLevel::Warning, message);
  }

  std::span<const InputImage> images_;  // of the whole batch
  std::span<const TemplateSet> sets_;
  Backend& backend_;
  const BatchOptions& options_;
  const BatchSettings& settings_;
  std::vector<EdgeModel> models_;
  int failed_ = 0;
  std::string last_failure_;
};

void work_through(const std::vector<Group>& open, Preparer& preparer, Detector& detector) {
  Progress progress("detect", open.size(), std::cerr, stderr_is_terminal());
  std::future<Prepared> next;
  if (!open.empty())
    next = std::async(std::launch::async, [&] { return preparer.prepare(open[0]); });
  for (std::size_t g = 0; g < open.size(); ++g) {
    Prepared prepared = next.get();
    if (g + 1 < open.size())
      next = std::async(std::launch::async, [&, g] { return preparer.prepare(open[g + 1]); });
    detector.work_on(open[g], std::move(prepared));
    progress.step();
  }
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
  const BatchSettings settings = settings_of(sets, options);
  Preparer preparer(options, settings.camera);
  Detector detector(images, sets, backend, options, settings);
  BatchSummary& summary = detector.summary;
  summary.images = static_cast<int>(images.size());
  std::vector<Group> open;
  for (Group& group : group_images(images, options.joint, settings)) {
    if (options.resume && is_done(group, options, settings))
      detector.skip(group);
    else
      open.push_back(std::move(group));
  }
  require_writable_place(options.out);
  warn_of_unknown_size({settings.camera, options.camera_file, options.scale_camera});
  try {
    work_through(open, preparer, detector);
  } catch (const std::exception& error) {
    summary.error = error.what();
    summary.seconds = seconds_since(start);
    write_ended(images, summary, backend.name(), options.out);
    throw;
  }
  detector.require_any_usable();
  summary.seconds = seconds_since(start);
  write_csv(images, summary, options.out);
  write_summary(summary, backend.name(), options.out);
  return summary;
}

}  // namespace edgescout
