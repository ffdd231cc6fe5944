// edgescout detect: finds objects of known CAD models in images, folders of images or BOP scenes.
#include <fmt/format.h>

#include <iostream>

#include "host/cli/batch.h"
#include "host/cli/common_arguments.h"
#include "host/cli/exit_codes.h"
#include "host/cli/option_table.h"
#include "host/cli/program_version.h"
#include "host/cli/shard_file.h"
#include "host/cli/template_sets.h"
#include "host/cli/verbs.h"
#include "host/cli/wanted_objects.h"
#include "host/core/log.h"
#include "host/io/files.h"
#include "host/io/folder_lock.h"
#include "kernels/error.h"

namespace edgescout {

namespace {

struct DetectRequest {
  std::vector<std::string> inputs;
  InputOptions reading;
  ModelArguments models;
  DatasetArguments dataset;
  TemplateOptions templates;
  std::string device = "auto", out;
  bool no_overlays = false;
  BatchOptions batch;
};

// Makes all cheap checks before it builds templates, so that nothing is written for an invalid
// request.
LoadedTemplates load_templates_for(const DetectRequest& request, std::span<const InputImage> images,
                                   Backend& backend) {
  const KnownModels known = load_models(request.models);
  const SearchedImages searched = searched_images(
      images, first_camera(images, request.batch.camera, request.batch.scale_camera),
      request.batch.pipeline.detect.scan.world);
  if (request.batch.joint) require_joinable(images);
  require_own_folder(request.batch.out, request.batch.shard);
  if (!request.batch.resume)
    require_no_other_results(request.batch.out,
                             images_of_shard(images, request.batch.joint, request.batch.shard));
  if (request.batch.joint) {
    const DistanceRange distances = searched_distances(known, request.templates, searched);
    for (const std::span<const InputImage> scene : groups_of(images, true))
      check_scene(scene, distances, searched.camera);
  }
  return template_sets_of(known, request.templates, searched, backend,
                          make_template_cache(request.models.cache));
}

int detect(DetectRequest& request) {
  request.batch.out = request.out;
  request.batch.depth = request.reading.depth;
  request.batch.overlays = !request.no_overlays;
  request.batch.version = program_version();
  request.batch.pipeline.validate();
  request.templates.validate();
  const std::unique_ptr<Backend> backend = backend_of(request.device);
  take_models_of_dataset(request.models, request.inputs, request.dataset, false);
  const std::vector<InputImage> images =
      list_images(request.inputs, request.batch.camera, request.dataset, request.reading);
  require_other_folder(images, request.batch.out);
  require_writable_place(request.batch.out);
  const FolderLock lock(request.batch.out);
  const LoadedTemplates templates = load_templates_for(request, images, *backend);
  request.batch.templates = templates.origins;
  warn_of_targets_without_model(images, templates.sets, request.dataset.targets);
  log(LogLevel::Info,
      fmt::format("{} images{}, {} models, on {}", images.size(),
                  request.batch.shard ? ", of them shard " + text_of(*request.batch.shard) : "",
                  templates.sets.size(), backend->name()));
  const BatchSummary summary = run_batch(images, templates.sets, *backend, request.batch);
  std::cout << fmt::format(
      "{} images: {} done, {} skipped, {} failed in {:.1f} s ({:.2f} images/s); {} poses in {} "
      "images; results in {}\n",
      summary.images, summary.done, summary.skipped, summary.failures.size(), summary.seconds,
      summary.done / std::max(1e-9, summary.seconds), summary.poses, summary.done + summary.skipped,
      request.out);
  return summary.failures.empty() ? exit_done : exit_some_failed;
}

void add_files(CLI::App& verb, DetectRequest& request) {
  add_images(verb, request.inputs);
  add_dataset_arguments(verb, request.dataset);
  add_model_arguments(verb, request.models);
  add_camera(verb, request.batch.camera);
  add_results_folder(verb, request.out);
  add_device(verb, request.device);
}

void add_options(CLI::App& verb, DetectRequest& request) {
  OptionTable(verb, "Batch")
      .flag("resume", request.batch.resume,
            "Skip images that have a result of the same models and options")
      .flag("joint", request.batch.joint,
            "Detect in all views of a BOP scene at once. The scene must have world poses, and "
            "nothing in it may move")
      .flag("no-overlays", request.no_overlays, "Write no overlay pictures");
  add_thumbnails(verb, request.batch.thumbnails);
  add_shard(verb, request.batch.shard);
  add_max_seconds(verb, request.batch.max_seconds);
  add_scale_camera(verb, request.batch.scale_camera);
  add_input_options(verb, request.reading);
  add_depth(verb, request.reading.depth);
  add_detection_options(verb, request.templates, request.batch.pipeline);
}

}  // namespace

void add_detect(CLI::App& app, int& exit_code) {
  CLI::App* verb = app.add_subcommand(
      "detect", "Find objects of known CAD models and their 6-DoF poses in images");
  auto request = std::make_shared<DetectRequest>();
  add_files(*verb, *request);
  add_options(*verb, *request);
  verb->callback([request, &exit_code, verb] {
    refuse_beside_templates(*verb);
    refuse_options_without_depth(*verb);
    request->batch.settings =
        settings_of(*verb, {"Images", "Depth", "Edges", "Tensor", "Detection"});
    exit_code = detect(*request);
  });
}

}  // namespace edgescout
