// edgescout explain: names the stage at which detection lost poses that are known to be right.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iostream>

#include "host/cli/common_arguments.h"
#include "host/cli/exit_codes.h"
#include "host/cli/explain_picture.h"
#include "host/cli/explain_report.h"
#include "host/cli/option_table.h"
#include "host/cli/progress.h"
#include "host/cli/register_job.h"
#include "host/cli/template_sets.h"
#include "host/cli/verbs.h"
#include "host/core/log.h"
#include "host/io/files.h"
#include "host/io/folder_lock.h"
#include "host/io/image.h"
#include "host/io/json_text.h"
#include "host/io/rotations.h"

namespace edgescout {

namespace {

namespace fs = std::filesystem;

struct ExplainRequest {
  std::vector<std::string> inputs;
  InputOptions reading;
  ModelArguments models;
  DatasetArguments dataset;
  TemplateOptions templates;
  std::vector<double> pose;  // R by row, t
  std::string poses;         // file
  bool truth = false;        // of BOP scenes
  double min_visible = 0.1;
  std::string out, device = "auto";
  RegisterOptions images;  // how images are read and prepared; the pipeline's options
  SamePoseOptions same;
};

// One argument says which poses are given; it is named in errors.
std::string source_of_poses(const ExplainRequest& request) {
  const int sources = int(!request.pose.empty()) + int(!request.poses.empty()) + int(request.truth);
  if (sources != 1)
    throw InputError("command line", "--pose, --poses, --truth",
                     sources == 0 ? "none" : "more than one", "one of the three");
  return request.truth ? "scene_gt.json" : request.poses.empty() ? "--pose" : request.poses;
}

StartPose pose_of_command_line(const ExplainRequest& request, std::span<const InputImage> images,
                               std::span<const RegisterModel> models) {
  if (images.size() != 1 || models.size() != 1)
    throw InputError("command line", "--pose",
                     fmt::format("{} images and {} models", images.size(), models.size()),
                     "one image and one model; --poses takes a file for more");
  const std::vector<double>& n = request.pose;
  Eigen::Matrix3d rotation;
  rotation << n[0], n[1], n[2], n[3], n[4], n[5], n[6], n[7], n[8];
  StartPose pose;
  pose.image_id = images[0].image_id;
  pose.object_id = models[0].object_id;
  ProjectedRotations projected;
  const std::optional<Se3> given = nearest_rigid(rotation, {n[9], n[10], n[11]}, projected);
  if (!given)
    throw InputError("command line", "--pose", "a matrix that is no rotation", EXPECTED_ROTATION);
  warn_of_projected(projected, "--pose");
  pose.camera_from_object = *given;
  return pose;
}

BopScene scene_with_truth(const InputImage& view) {
  BopScene scene;
  if (!view.scene_folder.empty()) scene = load_bop_scene(view.scene_folder, view.camera_name);
  if (scene.truth.empty())
    throw InputError(
        view.file.string(), "ground truth", "none",
        "an image of a BOP scene with " + bop_file("", "scene_gt", view.camera_name).string());
  return scene;
}

// Objects without a model are left out.
std::vector<StartPose> true_poses(std::span<const InputImage> images,
                                  std::span<const RegisterModel> models, double min_visible) {
  std::vector<StartPose> poses;
  for (const std::span<const InputImage> views : groups_of(images, true)) {
    std::map<std::string, BopScene> scenes;  // by camera
    for (const InputImage& view : views) {
      BopScene& scene = scenes[view.camera_name];
      if (scene.images.empty()) scene = scene_with_truth(view);
      const auto in_image = scene.truth.find(view.image_id);
      if (in_image == scene.truth.end()) continue;
      for (const BopTruth& t : in_image->second)
        if (t.visible_fraction >= min_visible &&
            std::ranges::count(models, t.object_id, &RegisterModel::object_id) > 0)
          poses.push_back({view.scene_id, view.image_id, "", view.camera_name, t.object_id,
                           t.camera_from_object});
    }
  }
  return poses;
}

// Before templates are built, so that poses that cannot be used are refused at once.
std::vector<RegisterJob> jobs_of(const ExplainRequest& request, std::span<const InputImage> images,
                                 const KnownModels& known) {
  std::vector<RegisterModel> models;
  for (const TemplateSet& set : known.sets) models.push_back({set.object_id, set.model});
  for (const Object& object : known.objects)
    models.push_back({object.id, make_edge_model(object.mesh)});
  const std::string source = source_of_poses(request);
  const std::vector<StartPose> poses =
      request.truth           ? true_poses(images, models, request.min_visible)
      : request.poses.empty() ? std::vector{pose_of_command_line(request, images, models)}
                              : load_start_poses(request.poses);
  return make_jobs(images, models, poses, false, source);
}

// Detects in the images one after the other and explains their poses.
class Explainer {
 public:
  Explainer(const ExplainRequest& request, std::span<const TemplateSet> sets, Backend& backend)
      : request_(request),
        sets_(sets),
        models_(models_of(sets)),
        depth_(request.images.depth),
        backend_(backend) {}

  // InputError: the image cannot be used.
  void explain(const RegisterJob& job) {
    const ReadyJob ready = prepare_job(job, depth_, backend_, request_.images);
    ObjectView view = ready.views[0].view;
    view.camera_from_world = job.views[0].camera_from_world.value_or(Se3{});
    DetectTrace trace;
    detect_objects(view, sets_, backend_, request_.images.pipeline, &trace);
    for (std::size_t i = 0; i < ready.starts.size(); ++i) {
      try {
        explain(ready, i, trace);
      } catch (const InputError& error) {
        fail(job, error);
      }
    }
  }

  // Of an image or a pose that cannot be used.
  void fail(const RegisterJob& job, const InputError& error) {
    failures_.push_back(fmt::format("{}: {}", job.views[0].file.string(), error.what()));
  }

  // Writes what was explained. If nothing could be, throws the last error.
  ExitCode finish() const {
    if (poses_.empty()) throw InputError(failures_.back());
    for (const std::string& failure : failures_) log(LogLevel::Warning, failure);
    if (!request_.out.empty())
      write_file_atomically(fs::path(request_.out) / "explain.json",
                            json_text(json_of(poses_, request_.same)));
    if (poses_.size() == 1) {
      std::cout << stage_table(poses_[0]);
    } else {
      for (const ExplainedPose& pose : poses_) std::cout << one_line(pose);
      std::cout << "\n" << summary_table(poses_);
    }
    return failures_.empty() ? exit_done : exit_some_failed;
  }

 private:
  void explain(const ReadyJob& ready, std::size_t start, const DetectTrace& trace) {
    const InputImage& input = ready.job->views[0];
    const Scene scene{models_, {&trace.view, 1}, backend_};
    const ObjectPose& given = ready.starts[start];
    const TemplateSet& set = sets_[std::size_t(given.object)];
    ExplainedPose pose{
        place_of(input),
        input.scene_id,
        input.image_id,
        set.object_id,
        given,
        "",
        explain_loss(scene, set, trace, given, request_.images.pipeline.detect, request_.same)};
    if (!request_.out.empty()) {
      pose.picture = fmt::format("{}_{}.png", input.name, start);
      save_png(explain_picture(scene, given, pose.report.rival),
               fs::path(request_.out) / pose.picture);
    }
    poses_.push_back(std::move(pose));
  }

  const ExplainRequest& request_;
  std::span<const TemplateSet> sets_;
  std::vector<EdgeModel> models_;
  DepthReader depth_;
  Backend& backend_;
  std::vector<ExplainedPose> poses_;
  std::vector<std::string> failures_;
};

// Nothing is locked where nothing is written.
std::optional<FolderLock> locked_out(const ExplainRequest& request,
                                     std::span<const InputImage> images) {
  if (request.out.empty()) return std::nullopt;
  require_other_folder(images, request.out);
  return std::optional<FolderLock>(std::in_place, request.out);
}

ExitCode explain(ExplainRequest& request) {
  request.images.pipeline.validate();
  request.templates.validate();
  request.same.validate();
  source_of_poses(request);
  const std::unique_ptr<Backend> backend = make_backend(request.device);
  take_models_of_dataset(request.models, request.inputs, request.dataset, false);
  const std::vector<InputImage> images =
      list_images(request.inputs, request.images.calibration, request.dataset, request.reading);
  const KnownModels known = load_models(request.models);
  RegisterOptions& options = request.images;
  options.camera = given_camera(options.calibration, images);
  warn_of_camera({options.camera, options.calibration.file, options.scale_camera});
  const SearchedImages searched =
      searched_images(images, first_camera(images, options.calibration, options.scale_camera),
                      options.pipeline.detect.scan.world);
  const std::vector<RegisterJob> jobs = jobs_of(request, images, known);
  const std::optional<FolderLock> lock = locked_out(request, images);
  const std::vector<TemplateSet> sets =
      template_sets_of(known, request.templates, searched, *backend,
                       make_template_cache(request.models.cache))
          .sets;
  Explainer explainer(request, sets, *backend);
  Progress progress("explain", jobs.size(), std::cerr, stderr_is_terminal());
  for (const RegisterJob& job : jobs) {
    try {
      explainer.explain(job);
    } catch (const InputError& error) {
      explainer.fail(job, error);
    }
    progress.step();
  }
  return explainer.finish();
}

void add_poses(CLI::App& verb, ExplainRequest& request) {
  CommandLineOptions(verb).numbers(
      {"pose",
       "The given pose: R by row and t, m, of the object in the camera frame. For one image and "
       "one model",
       OptionLevel::Basic},
      request.pose, 12, -100, 100);
  verb.get_option("--pose")->type_name("R t");
  verb.add_option("--poses", request.poses,
                  "Given poses: a BOP results CSV (t in mm), a result of this program, or a JSON "
                  "list of {image, object, R, t} (t in m)")
      ->type_name("FILE");
  OptionTable(verb, "Given poses")
      .flag("truth", request.truth, "Take all true poses of the BOP scenes' scene_gt.json")
      .bounded("min-visible", request.min_visible, 0.0, 1.0,
               "True poses with a smaller visible fraction are left out");
}

void add_files(CLI::App& verb, ExplainRequest& request) {
  add_images(verb, request.inputs);
  add_dataset_arguments(verb, request.dataset);
  add_poses(verb, request);
  add_model_arguments(verb, request.models);
  add_camera(verb, request.images.calibration);
  verb.add_option("--out", request.out,
                  "Folder for explain.json and a picture of each given pose. Without it nothing is "
                  "written")
      ->type_name("DIR");
  add_device(verb, request.device);
}

void add_options(CLI::App& verb, ExplainRequest& request) {
  add_scale_camera(verb, request.images.scale_camera);
  add_input_options(verb, request.reading);
  CommandLineOptions add(verb);
  describe(request.same, add);
  add_detection_options(verb, request.templates, request.images.pipeline);
}

}  // namespace

void add_explain(CLI::App& app, int& exit_code) {
  CLI::App* verb = app.add_subcommand(
      "explain", "Name the stage at which detection lost poses that are known to be right");
  auto request = std::make_shared<ExplainRequest>();
  add_files(*verb, *request);
  add_options(*verb, *request);
  verb->callback([request, &exit_code, verb] {
    refuse_beside_templates(*verb);
    exit_code = explain(*request);
  });
}

}  // namespace edgescout
