// edgescout register: refines given poses of any origin, in one view or over all views of a scene.
#include <fmt/format.h>

#include <iostream>
#include <limits>

#include "host/cli/common_arguments.h"
#include "host/cli/exit_codes.h"
#include "host/cli/option_table.h"
#include "host/cli/program_version.h"
#include "host/cli/register_batch.h"
#include "host/cli/symmetry_arguments.h"
#include "host/cli/template_sets.h"
#include "host/cli/verbs.h"
#include "host/io/files.h"
#include "host/io/folder_lock.h"
#include "host/model/mesh_quality.h"
#include "kernels/error.h"

namespace edgescout {

namespace {

struct RegisterRequest {
  std::vector<std::string> inputs;
  InputOptions reading;
  std::string poses, out, device = "auto";
  ModelArguments models;
  DatasetArguments dataset;
  bool multi_view = false, no_overlays = false;
  RegisterOptions options;
};

std::vector<RegisterModel> models_of(const RegisterRequest& request) {
  KnownModels known = load_models(request.models);
  std::vector<RegisterModel> models;
  for (TemplateSet& set : known.sets) models.push_back({set.object_id, std::move(set.model)});
  for (const Object& object : known.objects)
    models.push_back({object.id, make_edge_model(object.mesh)});
  return models;
}

// The file of start poses must not be one that the run overwrites.
void require_safe_starts(const RegisterRequest& request) {
  namespace fs = std::filesystem;
  std::error_code not_there;
  const fs::path folder = fs::absolute(request.poses).parent_path();
  if (!request.options.resume && fs::equivalent(folder, request.out, not_there))
    throw InputError("command line", "--poses", "a file in the folder of the results",
                     "another --out");
}

// The distances of the starts from the cameras of their views.
DistanceRange distances_of(const RegisterJob& job, std::span<const RegisterModel> models) {
  DistanceRange range{std::numeric_limits<double>::infinity(), 0};
  for (const RegisterJob::Start& start : job.starts) {
    const EdgeModel& model = models[std::size_t(start.model)].edges;
    const double distance_m = (start.camera_from_object * model.center_m).norm();
    range = {std::min(range.min_m, distance_m), std::max(range.max_m, distance_m)};
  }
  return range;
}

int register_all(RegisterRequest& request) {
  RegisterOptions& options = request.options;
  options.out = request.out;
  options.overlays = !request.no_overlays;
  options.depth = request.reading.depth;
  options.version = program_version();
  options.pipeline.validate();
  options.refine.validate();
  const std::unique_ptr<Backend> backend = backend_of(request.device);
  take_models_of_dataset(request.models, request.inputs, request.dataset, false);
  const std::vector<RegisterModel> models = models_of(request);
  for (const RegisterModel& model : models) warn_of_mesh(model.edges);
  require_safe_starts(request);
  const std::vector<StartPose> poses = load_start_poses(request.poses);
  const std::vector<InputImage> images =
      list_images(request.inputs, options.calibration, request.dataset, request.reading);
  options.camera = given_camera(options.calibration, images);
  require_other_folder(images, options.out);
  require_writable_place(options.out);
  const FolderLock lock(options.out);
  const std::vector<RegisterJob> jobs =
      make_jobs(images, models, poses, request.multi_view, request.poses);
  if (request.multi_view) {
    const Camera camera = first_camera(images, options.calibration, options.scale_camera);
    for (const RegisterJob& job : jobs) check_scene(job.views, distances_of(job, models), camera);
  }
  const RegisterSummary summary = run_register(jobs, models, *backend, options);
  std::cout << fmt::format(
      "{} poses in {} images refined on {}, {} out of sight, {} images skipped, {} failed in "
      "{:.1f} s; results in {}\n",
      summary.refined, summary.done, backend->name(), summary.out_of_sight, summary.skipped,
      summary.images - summary.done - summary.skipped, summary.seconds, request.out);
  return summary.failures.empty() && summary.out_of_sight == 0 ? exit_done : exit_some_failed;
}

void add_files(CLI::App& verb, RegisterRequest& request) {
  add_images(verb, request.inputs);
  add_dataset_arguments(verb, request.dataset);
  verb.add_option(
          "--poses", request.poses,
          "Poses to start from: a BOP results CSV (t in mm), a result of this program, or a JSON "
          "list of {image, object, R, t} (t in m); R and t map the object frame to the camera "
          "frame")
      ->required()
      ->type_name("FILE");
  verb.add_option("--model", request.models.models, "CAD files of the objects: " + MESH_FORMATS)
      ->type_name("FILE");
  verb.add_option("--unit", request.models.unit, UNIT_HELP);
  verb.add_option("--object-id", request.models.object_ids,
                  "BOP ids of the models; default: the number at the end of their names");
  add_symmetry(verb, request.models.symmetry);
  verb.add_option("--templates", request.models.templates,
                  "Template files of `edgescout model build`, in place of --model")
      ->type_name("FILE");
  add_camera(verb, request.options.calibration);
  add_results_folder(verb, request.out);
  add_device(verb, request.device);
}

void add_options(CLI::App& verb, RegisterRequest& request) {
  OptionTable(verb, "Registration")
      .flag("multi-view", request.multi_view,
            "Refine each pose in all views of its BOP scene at once. The scene must have world "
            "poses");
  OptionTable(verb, "Batch")
      .flag("resume", request.options.resume,
            "Skip images that have a result of the same models and options")
      .flag("no-overlays", request.no_overlays, "Write no overlay pictures");
  add_thumbnails(verb, request.options.thumbnails);
  add_shard(verb, request.options.shard);
  add_max_seconds(verb, request.options.max_seconds);
  add_scale_camera(verb, request.options.scale_camera);
  add_input_options(verb, request.reading);
  add_depth(verb, request.reading.depth);
  CommandLineOptions add(verb);
  describe(request.options.refine, add);
  describe(request.options.pipeline.edges, add);
  describe(request.options.pipeline.tensor, add);
}

}  // namespace

void add_register(CLI::App& app, int& exit_code) {
  CLI::App* verb =
      app.add_subcommand("register", "Refine given poses, of this program or of any other method");
  auto request = std::make_shared<RegisterRequest>();
  add_files(*verb, *request);
  add_options(*verb, *request);
  verb->callback([request, &exit_code, verb] {
    refuse_beside_templates(*verb);
    refuse_options_without_depth(*verb);
    request->options.settings =
        settings_of(*verb, {"Registration", "Images", "Depth", "Edges", "Tensor"});
    exit_code = register_all(*request);
  });
}

}  // namespace edgescout
