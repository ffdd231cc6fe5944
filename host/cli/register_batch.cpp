#include "host/cli/register_batch.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <iostream>
#include <limits>

#include "host/cli/depth_warnings.h"
#include "host/cli/progress.h"
#include "host/cli/register_job.h"
#include "host/cli/shard_file.h"
#include "host/cli/view_results.h"
#include "host/core/log.h"
#include "host/core/stopwatch.h"
#include "host/io/binary_file.h"
#include "host/io/files.h"
#include "kernels/error.h"

namespace edgescout {

namespace {

using Clock = std::chrono::steady_clock;

// The views in which starts were given. Each of them gets a result.
std::vector<std::size_t> views_with_starts(const RegisterJob& job) {
  std::vector<std::size_t> views;
  for (std::size_t view = 0; view < job.views.size(); ++view)
    if (std::ranges::any_of(job.starts,
                            [&](const RegisterJob::Start& start) { return start.view == view; }))
      views.push_back(view);
  return views;
}

BatchSettings settings_of(std::span<const RegisterModel> models, const RegisterOptions& options) {
  BatchSettings settings{options.settings, options.camera};
  for (const RegisterModel& model : models)
    settings.common.push_back(setting_of(model.object_id, model.edges));
  return settings;
}

std::string text_of(const std::vector<RegisterJob::Start>& starts,
                    std::span<const RegisterModel> models) {
  BinaryWriter out;
  for (const RegisterJob::Start& start : starts) {
    out.put(static_cast<std::uint64_t>(start.view));
    out.put(models[static_cast<std::size_t>(start.model)].object_id);
    out.put_pose(start.camera_from_object);
  }
  return fmt::format("{}, {}", starts.size(), checksum_text(out.bytes));
}

std::string views_of(const RegisterJob& job, const BatchSettings& settings) {
  if (job.views.size() == 1) return "alone";
  std::vector<const InputImage*> views;
  for (const InputImage& view : job.views) views.push_back(&view);
  return settings.jointly(views);
}

std::vector<InputImage> all_views(std::span<const RegisterJob> jobs) {
  std::vector<InputImage> views;
  for (const RegisterJob& job : jobs) views.insert(views.end(), job.views.begin(), job.views.end());
  return views;
}

// The jobs of the shard; without one, all.
std::vector<RegisterJob> jobs_of_shard(std::span<const RegisterJob> jobs,
                                       const std::optional<Shard>& shard) {
  if (!shard) return {jobs.begin(), jobs.end()};
  std::vector<std::span<const InputImage>> groups;
  for (const RegisterJob& job : jobs) groups.emplace_back(job.views);
  const std::vector<bool> belongs = in_shard(groups, *shard);
  std::vector<RegisterJob> chosen;
  for (std::size_t j = 0; j < jobs.size(); ++j)
    if (belongs[j]) chosen.push_back(jobs[j]);
  return chosen;
}

bool has_joint_views(std::span<const RegisterJob> jobs) {
  return std::ranges::any_of(jobs, [](const RegisterJob& job) { return job.views.size() > 1; });
}

// Where the surfaces of objects at about these poses may be, along the camera's axis.
Range distances_in(const Se3& camera_from_world, std::span<const ObjectPose> poses,
                   std::span<const EdgeModel> models) {
  constexpr double radii = 2;  // starts are not exact
  Range distances{std::numeric_limits<double>::infinity(), 0};
  for (const ObjectPose& pose : poses) {
    const EdgeModel& model = models[std::size_t(pose.object)];
    const double z_m = (camera_from_world * (pose.world_from_object * model.center_m)).z();
    distances.low = std::min(distances.low, std::max(0.0, z_m - radii * model.radius_m));
    distances.high = std::max(distances.high, z_m + radii * model.radius_m);
  }
  return distances;
}

// Runs the jobs of a batch one after the other.
class RegisterRun {
 public:
  RegisterRun(std::vector<InputImage> views, std::span<const RegisterModel> models,
              Backend& backend, const RegisterOptions& options)
      : views_(std::move(views)),
        models_(models),
        backend_(backend),
        options_(options),
        depth_(options.depth),
        settings_(settings_of(models, options)) {
    for (const RegisterModel& model : models) edge_models_.push_back(model.edges);
  }

  // Checks every view, also after one without a result: any existing result must be of this run.
  bool is_done(const RegisterJob& job) const {
    bool all_done = true;
    for (std::size_t view : views_with_starts(job))
      all_done &= edgescout::is_done(options_.out, job.views[view], settings_of_view(job, view));
    return all_done;
  }

  // InputError: an image that cannot be used.
  std::pair<ReadyJob, Detections> refine(const RegisterJob& job) {
    ReadyJob ready = prepare_job(job, depth_, backend_, options_);
    for (std::size_t v = 0; v < job.views.size(); ++v)
      depth_warnings.check_view(
          job.views[v].file.string(), ready.views[v].view,
          distances_in(ready.views[v].view.camera_from_world, ready.starts, edge_models_));
    Detections found = refine_job(ready, models_, edge_models_, backend_, options_);
    if (job.views.size() == 1)
      depth_warnings.compare(job.views[0].file.string(),
                             {edge_models_, {&ready.views[0].view, 1}, backend_}, found.detections);
    return {std::move(ready), std::move(found)};
  }

  // InputError: a folder that cannot be written.
  void write(const ReadyJob& ready, const Detections& found) {
    const RegisterJob& job = *ready.job;
    require_writable_folder(options_.out);
    // Earlier results are removed only when there are new ones.
    if (!options_.resume && summary.finished.empty()) start_anew(options_.out, views_);
    for (std::size_t view = 0; options_.overlays && view < job.views.size(); ++view)
      save_overlay(job.views[view], {edge_models_, {&ready.views[view].view, 1}, backend_},
                   found.detections, options_.out);
    for (std::size_t view : views_with_starts(job)) {
      ImageResult result = result_of(ready, view, found, models_, backend_);
      result.settings = settings_of_view(job, view);
      save_result(result, options_.out, job.views[view]);
      summary.finished.insert(job.views[view].name);
      ++summary.done;
    }
    for (const StageSeconds& stage : found.stages)
      summary.stage_seconds[stage.name] += stage.seconds;
    summary.refined += static_cast<int>(std::ranges::count_if(
        found.detections, [](const Detection& d) { return d.convergence != OUT_OF_SIGHT; }));
  }

  void skip(const RegisterJob& job) {
    for (std::size_t view : views_with_starts(job)) {
      summary.finished.insert(job.views[view].name);
      ++summary.skipped;
    }
  }

  RegisterSummary summary;
  DepthWarnings depth_warnings;

 private:
  Settings settings_of_view(const RegisterJob& job, std::size_t view) const {
    Settings settings = settings_.of(job.views[view], views_of(job, settings_));
    settings.emplace_back("starts", text_of(job.starts, models_));
    return settings;
  }

  std::vector<InputImage> views_;  // of all jobs
  std::span<const RegisterModel> models_;
  Backend& backend_;
  const RegisterOptions& options_;
  DepthReader depth_;
  BatchSettings settings_;
  std::vector<EdgeModel> edge_models_;
};

std::vector<InputImage> images_of(std::span<const RegisterJob> jobs) {
  std::vector<InputImage> images;
  for (const RegisterJob& job : jobs)
    for (std::size_t view : views_with_starts(job)) images.push_back(job.views[view]);
  return images;
}

// Existing results are checked before any work: a result of another run ends the batch.
std::vector<const RegisterJob*> skip_done(std::span<const RegisterJob> jobs, RegisterRun& run,
                                          bool resume) {
  std::vector<const RegisterJob*> open;
  for (const RegisterJob& job : jobs)
    if (resume && run.is_done(job))
      run.skip(job);
    else
      open.push_back(&job);
  return open;
}

void list_failure(const RegisterJob& job, const std::string& message, RegisterSummary& summary) {
  for (std::size_t view : views_with_starts(job))
    summary.failures[job.views[view].file.string()] = message;
  log(LogLevel::Warning, message);
}

// `may_all_fail`: another shard may have good images.
void work_through(const std::vector<const RegisterJob*>& open, RegisterRun& run,
                  bool may_all_fail) {
  Progress progress("register", open.size(), std::cerr, stderr_is_terminal());
  std::size_t failed = 0;
  for (const RegisterJob* job : open) {
    std::optional<std::pair<ReadyJob, Detections>> refined;
    try {
      refined = run.refine(*job);
    } catch (const InputError& error) {
      if (++failed == open.size() && run.summary.skipped == 0 && !may_all_fail) throw;
      list_failure(*job, error.what(), run.summary);
    }
    if (refined) run.write(refined->first, refined->second);
    progress.step();
  }
}

// The settings of all images, with a checksum of all starts.
BatchSettings settings_of_batch(std::span<const RegisterJob> jobs,
                                std::span<const RegisterModel> models,
                                const RegisterOptions& options) {
  BatchSettings settings = settings_of(models, options);
  std::vector<RegisterJob::Start> starts;
  for (const RegisterJob& job : jobs)
    starts.insert(starts.end(), job.starts.begin(), job.starts.end());
  settings.common.emplace_back("starts of the batch", text_of(starts, models));
  return settings;
}

}  // namespace

RegisterSummary run_register(std::span<const RegisterJob> all_jobs,
                             std::span<const RegisterModel> models, Backend& backend,
                             const RegisterOptions& options) {
  const auto start = Clock::now();
  const std::vector<RegisterJob> jobs = jobs_of_shard(all_jobs, options.shard);
  const std::vector<InputImage> images = images_of(jobs);
  const ShardOfBatch shard(
      options.shard, {options.version, "register", has_joint_views(all_jobs), 0, "", {}},
      settings_of_batch(all_jobs, models, options), images_of(all_jobs), images);
  shard.require_own(options.out);
  RegisterRun run(all_views(jobs), models, backend, options);
  RegisterSummary& summary = run.summary;
  summary.verb = "register";
  summary.by_scene = has_joint_views(all_jobs);
  summary.images = static_cast<int>(images.size());
  const std::vector<const RegisterJob*> open = skip_done(jobs, run, options.resume);
  require_writable_place(options.out);
  if (!options.resume) require_no_other_results(options.out, all_views(jobs));
  shard.save(options.out);
  warn_of_camera({options.camera, options.calibration.file, options.scale_camera});
  const auto write_summary_of = [&](const std::exception& error) {
    summary.error = error.what();
    summary.seconds = seconds_since(start);
    write_ended(images, summary, backend.name(), {options.out, options.thumbnails});
  };
  try {
    work_through(open, run, options.shard.has_value());
    run.depth_warnings.log_warnings();
  } catch (const InputError& error) {  // if no image can be used, nothing is written
    if (!summary.finished.empty()) write_summary_of(error);
    throw;
  } catch (const std::exception& error) {
    if (std::filesystem::exists(options.out)) write_summary_of(error);
    throw;
  }
  summary.seconds = seconds_since(start);
  write_tables(images, summary, backend.name(), {options.out, options.thumbnails});
  return summary;
}

}  // namespace edgescout
