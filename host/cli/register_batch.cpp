#include "host/cli/register_batch.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <iostream>

#include "host/cli/progress.h"
#include "host/core/log.h"
#include "host/detect/detect.h"
#include "host/detect/observation.h"
#include "host/io/binary_file.h"
#include "host/io/files.h"
#include "host/io/image.h"
#include "host/io/overlay.h"
#include "kernels/error.h"

namespace edgescout {

namespace {

using Clock = std::chrono::steady_clock;
double seconds_since(Clock::time_point start) {
  return std::chrono::duration<double>(Clock::now() - start).count();
}

// A job whose images are read.
struct ReadyJob {
  const RegisterJob* job;
  std::vector<PreparedImage> views;
  std::vector<Hypothesis> starts;  // world from object
};

PreparedImage prepare_view(const InputImage& input, bool is_alone, Backend& backend,
                           const RegisterOptions& options) {
  const Image image = load_image(input.file);
  const Camera camera = camera_of(input, image.width, image.height,
                                  {options.camera, options.camera_file, options.scale_camera});
  const Se3 camera_from_world = is_alone ? Se3{} : *input.camera_from_world;
  return naming(input,
                [&] { return prepare_image(image, camera, camera_from_world, backend, options.pipeline); });
}

ReadyJob prepare_job(const RegisterJob& job, Backend& backend, const RegisterOptions& options) {
  ReadyJob ready{&job, {}, {}};
  for (const InputImage& view : job.views)
    ready.views.push_back(prepare_view(view, job.views.size() == 1, backend, options));
  for (const RegisterJob::Start& start : job.starts)
    ready.starts.push_back(
        {start.model, inverse(ready.views[start.view].camera_from_world) * start.camera_from_object});
  return ready;
}

// Of the smallest object as the starts have it in this view; the image's size where none is in front of it.
double smallest_size_px(const ReadyJob& ready, const PreparedImage& view,
                        std::span<const RegisterModel> models) {
  double smallest = std::max(view.camera.width, view.camera.height);
  for (const Hypothesis& start : ready.starts) {
    const EdgeModel& model = models[static_cast<std::size_t>(start.object)].edges;
    const double depth_m = (view.camera_from_world * (start.world_from_object * model.center_m)).z();
    if (depth_m > 0) smallest = std::min(smallest, model.mesh.diameter_m / depth_m * view.camera.fx);
  }
  return smallest;
}

// Whether the object's bounding sphere does, which looks longer the farther from the axis it is.
bool reaches_into(const PreparedImage& view, const EdgeModel& model, const Se3& world_from_object) {
  const Camera& camera = view.camera;
  const Eigen::Vector3d center_m = view.camera_from_world * (world_from_object * model.center_m);
  if (!(center_m.z() > 0)) return false;
  const Eigen::Vector2d center_px = project(camera, center_m);
  const double depth_m = center_m.z(), longer = center_m.norm() / depth_m,
               radius_px = model.radius_m / depth_m * std::max(camera.fx, camera.fy) * longer;
  return center_px.x() > -radius_px && center_px.x() < camera.width + radius_px &&
         center_px.y() > -radius_px && center_px.y() < camera.height + radius_px;
}

// What starts outside of every image is drawn to anything inside, however far away; what is a speck fits
// everywhere.
bool is_out_of_sight(const ReadyJob& ready, const Hypothesis& start, const EdgeModel& model,
                     const PoseFeatures& refined) {
  constexpr double least_px = 20;  // of visible edges, in all images together
  return refined.length_px < least_px || std::ranges::none_of(ready.views, [&](const PreparedImage& view) {
           return reaches_into(view, model, start.world_from_object);
         });
}

void tell_out_of_sight(const ReadyJob& ready, std::size_t start, const RegisterModel& model) {
  const InputImage& input = ready.job->views[ready.job->starts[start].view];
  log(LogLevel::Warning,
      fmt::format(
          "{}: object {}: found a start that no image shows, expected one in sight (lengths are in mm "
          "in a BOP results CSV, in m in JSON)",
          input.file.string(), model.object_id));
}

Detections refine_job(const ReadyJob& ready, std::span<const RegisterModel> models,
                      std::span<const EdgeModel> edge_models, Backend& backend,
                      const RegisterOptions& options) {
  Detections result;
  for (const PreparedImage& view : ready.views)
    result.stages.insert(result.stages.end(), view.stages.begin(), view.stages.end());
  const auto start = Clock::now();
  std::vector<RegisterView> views;
  for (std::size_t i = 0; i < ready.views.size(); ++i) {
    const PreparedImage& view = ready.views[i];
    const double reduction = reduction_for(smallest_size_px(ready, view, models));
    views.push_back(naming(ready.job->views[i], [&] {
                      return observe(view.image, view.camera, view.camera_from_world, view.edges, reduction,
                                     options.pipeline.tensor, backend);
                    }).view);
  }
  result.stages.push_back({"tensors", seconds_since(start)});
  const auto tensors_made = Clock::now();
  const std::vector<Refined> refined =
      refine_poses(edge_models, ready.starts, views, backend, options.refine);
  result.stages.push_back({"registration", seconds_since(tensors_made)});
  for (std::size_t i = 0; i < refined.size(); ++i) {
    const Hypothesis& given = ready.starts[i];
    const RegisterModel& model = models[static_cast<std::size_t>(given.object)];
    Detection& found = result.detections.emplace_back(
        to_detection(given.object, refined[i].registration, refined[i].features));
    if (!is_out_of_sight(ready, given, model.edges, refined[i].features)) continue;
    found.probability = 0;
    found.convergence = OUT_OF_SIGHT;
    tell_out_of_sight(ready, i, model);
  }
  return result;
}

ImageResult result_of(const ReadyJob& ready, std::size_t view, const Detections& found,
                      std::span<const RegisterModel> models, const Backend& backend) {
  const InputImage& input = ready.job->views[view];
  ImageResult result;
  result.image = place_of(input);
  result.scene_id = input.scene_id;
  result.image_id = input.image_id;
  result.camera = ready.views[view].camera;
  result.device = backend.name();
  result.stages = found.stages;
  result.camera_from_world = input.camera_from_world;
  for (const RegisterModel& model : models)
    result.objects.push_back({model.object_id, model.edges.mesh.name});
  for (std::size_t i = 0; i < found.detections.size(); ++i)
    if (ready.job->starts[i].view == view) result.detections.push_back(found.detections[i]);
  if (ready.views.size() == 1) carry_to_world(result);
  return result;
}

void save_overlay(const ReadyJob& ready, std::size_t view, const Detections& found,
                  std::span<const EdgeModel> edge_models, Backend& backend, const RegisterOptions& options) {
  const PreparedImage& prepared = ready.views[view];
  std::vector<OverlayPose> poses;
  for (const Detection& d : found.detections)
    poses.push_back({d.object, prepared.camera_from_world * d.world_from_object, d.probability,
                     edge_models[static_cast<std::size_t>(d.object)].mesh.name});
  const EdgeIndex edges(prepared.edges, prepared.camera.width, prepared.camera.height);
  save_png(draw_overlay(prepared.image, prepared.camera, poses, edge_models, &edges, backend),
           overlay_of(options.out, ready.job->views[view]));
}

// The images that starts were given in: those that get a result of their own.
std::vector<std::size_t> views_with_starts(const RegisterJob& job) {
  std::vector<std::size_t> views;
  for (std::size_t view = 0; view < job.views.size(); ++view)
    if (std::ranges::any_of(job.starts, [&](const RegisterJob::Start& start) { return start.view == view; }))
      views.push_back(view);
  return views;
}

BatchSettings settings_of(std::span<const RegisterModel> models, const RegisterOptions& options) {
  BatchSettings settings{options.settings, options.camera};
  for (const RegisterModel& model : models)
    settings.common.push_back(setting_of(model.object_id, model.edges));
  return settings;
}

std::string text_of(const std::vector<RegisterJob::Start>& starts, std::span<const RegisterModel> models) {
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

// The batch job by job.
class Registrar {
 public:
  Registrar(std::vector<InputImage> views, std::span<const RegisterModel> models, Backend& backend,
            const RegisterOptions& options)
      : views_(std::move(views)),
        models_(models),
        backend_(backend),
        options_(options),
        settings_(settings_of(models, options)) {
    for (const RegisterModel& model : models) edge_models_.push_back(model.edges);
  }

  // Each is judged, also after one that is missing: what is there must not be another run's.
  bool is_done(const RegisterJob& job) const {
    bool all_done = true;
    for (std::size_t view : views_with_starts(job))
      all_done &= edgescout::is_done(options_.out, job.views[view], settings_of_view(job, view));
    return all_done;
  }

  // InputError: an image that cannot be used.
  std::pair<ReadyJob, Detections> refine(const RegisterJob& job) const {
    ReadyJob ready = prepare_job(job, backend_, options_);
    Detections found = refine_job(ready, models_, edge_models_, backend_, options_);
    return {std::move(ready), std::move(found)};
  }

  // InputError: a folder that cannot be written.
  void write(const ReadyJob& ready, const Detections& found) {
    const RegisterJob& job = *ready.job;
    require_writable_folder(options_.out);
    // Not before there is something in their place.
    if (!options_.resume && summary.finished.empty()) start_anew(options_.out, views_);
    for (std::size_t view = 0; options_.overlays && view < job.views.size(); ++view)
      save_overlay(ready, view, found, edge_models_, backend_, options_);
    for (std::size_t view : views_with_starts(job)) {
      ImageResult result = result_of(ready, view, found, models_, backend_);
      result.settings = settings_of_view(job, view);
      save_image_result(result, json_of(options_.out, job.views[view]));
      summary.finished.insert(job.views[view].name);
      ++summary.done;
    }
    for (const StageSeconds& stage : found.stages) summary.stage_seconds[stage.name] += stage.seconds;
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
  BatchSettings settings_;
  std::vector<EdgeModel> edge_models_;
};

std::vector<InputImage> images_of(std::span<const RegisterJob> jobs) {
  std::vector<InputImage> images;
  for (const RegisterJob& job : jobs)
    for (std::size_t view : views_with_starts(job)) images.push_back(job.views[view]);
  return images;
}

// Judged before any work: a result of another run ends the batch.
std::vector<const RegisterJob*> skip_done(std::span<const RegisterJob> jobs, Registrar& registrar,
                                          bool resume) {
  std::vector<const RegisterJob*> open;
  for (const RegisterJob& job : jobs)
    if (resume && registrar.is_done(job))
      registrar.skip(job);
    else
      open.push_back(&job);
  return open;
}

void work_through(const std::vector<const RegisterJob*>& open, Registrar& registrar) {
  Progress progress("register", open.size(), std::cerr, stderr_is_terminal());
  std::size_t failed = 0;
  for (const RegisterJob* job : open) {
    std::optional<std::pair<ReadyJob, Detections>> refined;
    try {
      refined = registrar.refine(*job);
    } catch (const InputError& error) {
      if (++failed == open.size() && registrar.summary.skipped == 0) throw;
      for (std::size_t view : views_with_starts(*job))
        registrar.summary.failures[job->views[view].file.string()] = error.what();
      log(LogLevel::Warning, error.what());
    }
    if (refined) registrar.write(refined->first, refined->second);
    progress.step();
  }
}

}  // namespace

RegisterSummary run_register(std::span<const RegisterJob> jobs, std::span<const RegisterModel> models,
                             Backend& backend, const RegisterOptions& options) {
  const auto start = Clock::now();
  const std::vector<InputImage> images = images_of(jobs);
  Registrar registrar(all_views(jobs), models, backend, options);
  RegisterSummary& summary = registrar.summary;
  summary.images = static_cast<int>(images.size());
  const std::vector<const RegisterJob*> open = skip_done(jobs, registrar, options.resume);
  require_writable_place(options.out);
  if (!options.resume) require_no_other_results(options.out, all_views(jobs));
  warn_of_unknown_size({options.camera, options.camera_file, options.scale_camera});
  const auto write_with = [&](const std::exception& error) {
    summary.error = error.what();
    summary.seconds = seconds_since(start);
    write_ended(images, summary, backend.name(), options.out);
  };
  try {
    work_through(open, registrar);
  } catch (const InputError& error) {  // where no image can be used nothing is written
    if (!summary.finished.empty()) write_with(error);
    throw;
  } catch (const std::exception& error) {
    if (std::filesystem::exists(options.out)) write_with(error);
    throw;
  }
  summary.seconds = seconds_since(start);
  write_csv(images, summary, options.out);
  write_summary(summary, backend.name(), options.out);
  return summary;
}

}  // namespace edgescout
