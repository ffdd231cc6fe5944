// edgescout track: follows objects from image to image.
#include <fmt/format.h>

#include <iostream>

#include "host/cli/common_arguments.h"
#include "host/cli/exit_codes.h"
#include "host/cli/option_table.h"
#include "host/cli/template_sets.h"
#include "host/cli/track_run.h"
#include "host/cli/verbs.h"
#include "host/io/files.h"
#include "host/io/folder_lock.h"
#include "kernels/error.h"

namespace edgescout {

namespace {

struct TrackArguments {
  std::vector<std::string> inputs;
  InputOptions reading;
  ModelArguments models;
  DatasetArguments dataset;
  TemplateOptions templates;
  std::string poses, device = "auto", out;
  bool no_search = false, no_overlays = false;
  TrackRequest request;
};

// Sets without templates: nothing is searched for.
std::vector<TemplateSet> models_alone(KnownModels known) {
  std::vector<TemplateSet> sets = std::move(known.sets);
  for (const Object& object : known.objects) sets.push_back(without_views(object));
  return sets;
}

std::vector<TemplateSet> sets_of(const TrackArguments& arguments,
                                 std::span<const InputImage> images, Backend& backend) {
  KnownModels known = load_models(arguments.models);
  if (arguments.no_search) return models_alone(std::move(known));
  const TrackRequest& request = arguments.request;
  const SearchedImages searched =
      searched_images(images, first_camera(images, request.calibration, request.scale_camera),
                      request.tracking.pipeline.detect.scan.world);
  return template_sets_of(known, arguments.templates, searched, backend,
                          make_template_cache(arguments.models.cache))
      .sets;
}

std::vector<RegisterJob> starts_of(const TrackArguments& arguments,
                                   std::span<const InputImage> images,
                                   std::span<const TemplateSet> sets) {
  if (arguments.poses.empty()) return {};
  std::vector<RegisterModel> models;
  for (const TemplateSet& set : sets) models.push_back({set.object_id, set.model});
  return make_jobs(images, models, load_start_poses(arguments.poses), false, arguments.poses);
}

int track(TrackArguments& arguments) {
  TrackRequest& request = arguments.request;
  if (arguments.no_search && arguments.poses.empty())
    throw InputError("command line", "--no-search", "no --poses", "poses to follow");
  request.out = arguments.out;
  request.search = !arguments.no_search;
  request.depth = arguments.reading.depth;
  request.overlays = !arguments.no_overlays;
  request.tracking.min_probability = request.tracking.pipeline.detect.min_probability;
  request.tracking.validate();
  arguments.templates.validate();
  const std::unique_ptr<Backend> backend = backend_of(arguments.device);
  take_models_of_dataset(arguments.models, arguments.inputs, arguments.dataset, false);
  const std::vector<InputImage> images =
      list_images(arguments.inputs, request.calibration, arguments.dataset, arguments.reading);
  require_other_folder(images, request.out);
  require_writable_place(request.out);
  const FolderLock lock(request.out);
  const std::vector<TemplateSet> sets = sets_of(arguments, images, *backend);
  const std::vector<RegisterJob> starts = starts_of(arguments, images, sets);
  const TrackSummary summary = run_track(images, sets, starts, *backend, request);
  std::cout << fmt::format(
      "{} frames, {} instances: {} poses tracked, {} doubtful, {} lost, {} times lost, {} images "
      "failed in {:.1f} s; results in {}\n",
      summary.frames, summary.instances, summary.tracked, summary.doubtful, summary.lost,
      summary.losses, summary.failures.size(), summary.seconds, arguments.out);
  return summary.failures.empty() ? exit_done : exit_some_failed;
}

void add_files(CLI::App& verb, TrackArguments& arguments) {
  add_images(verb, arguments.inputs);
  add_dataset_arguments(verb, arguments.dataset);
  add_model_arguments(verb, arguments.models);
  verb.add_option("--poses", arguments.poses,
                  "Poses from which objects are followed, in the formats of `register`; without "
                  "them they are searched for")
      ->type_name("FILE");
  add_camera(verb, arguments.request.calibration);
  add_depth(verb, arguments.reading.depth);
  add_results_folder(verb, arguments.out);
  add_device(verb, arguments.device);
}

void add_options(CLI::App& verb, TrackArguments& arguments) {
  TrackRequest& request = arguments.request;
  OptionTable(verb, "Tracking")
      .flag("no-search", arguments.no_search,
            "Search for nothing: follow the given poses until they are lost")
      .bounded("search-every", request.search_every, 1, 1'000'000,
               "Search for missing objects in every Nth frame")
      .bounded("frame-rate", request.frame_rate, 0.0, 1e6,
               "Frames a second, for the column time_s; 0: as a video's file says, else 30")
      .flag("no-overlays", arguments.no_overlays, "Write no overlay pictures");
  add_max_seconds(verb, request.max_seconds);
  add_scale_camera(verb, request.scale_camera);
  add_input_options(verb, arguments.reading);
  CommandLineOptions add(verb);
  describe(arguments.templates, add);
  describe_track(request.tracking, add);
}

}  // namespace

void add_track(CLI::App& app, int& exit_code) {
  CLI::App* verb = app.add_subcommand("track", "Follow objects from image to image");
  auto arguments = std::make_shared<TrackArguments>();
  add_files(*verb, *arguments);
  add_options(*verb, *arguments);
  verb->callback([arguments, &exit_code, verb] {
    refuse_beside_templates(*verb);
    refuse_options_without_depth(*verb);
    exit_code = track(*arguments);
  });
}

}  // namespace edgescout
