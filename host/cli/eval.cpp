// edgescout eval: evaluates the poses of a BOP results CSV.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cmath>
#include <iostream>
#include <limits>
#include <nlohmann/json.hpp>
#include <set>

#include "host/cli/common_arguments.h"
#include "host/cli/eval_targets.h"
#include "host/cli/exit_codes.h"
#include "host/cli/inputs.h"
#include "host/cli/option_table.h"
#include "host/cli/output_file.h"
#include "host/cli/symmetry_arguments.h"
#include "host/cli/verbs.h"
#include "host/core/log.h"
#include "host/eval/average_precision.h"
#include "host/eval/recall.h"
#include "host/eval/vsd_tables.h"
#include "host/io/files.h"
#include "host/io/image.h"
#include "host/io/json_text.h"
#include "kernels/error.h"
#include "kernels/thread_pool.h"

namespace edgescout {

namespace fs = std::filesystem;

namespace {

struct EvalRequest {
  std::string results, json_file;
  std::vector<std::string> scenes;
  ModelArguments models;
  DatasetArguments dataset;
  RecallOptions recall;
  int most_estimates = 100;
  bool vsd = true;
  double vsd_delta_m = VSD_DELTA_M;
};

// Each argument is a scene, a folder of scenes, or with a split a dataset.
std::vector<fs::path> scene_folders(const EvalRequest& request) {
  std::vector<fs::path> folders;
  for (const std::string& argument : request.scenes) {
    const fs::path place = folder_of_split(argument, request.dataset);
    const std::size_t before = folders.size();
    if (is_bop_scene(place)) {
      folders.push_back(place);
    } else if (fs::is_directory(place)) {
      for (const fs::directory_entry& entry : fs::directory_iterator(place))
        if (is_bop_scene(entry.path())) folders.push_back(entry.path());
    }
    if (folders.size() == before)
      throw InputError(place.string(), "scene", "no scene_camera.json, " + splits_in(place),
                       "a BOP scene, a folder of BOP scenes, or --split for a dataset");
  }
  return folders;
}

// One for each camera of a scene.
std::vector<BopScene> load_scenes(const EvalRequest& request) {
  std::vector<BopScene> scenes;
  SceneLoader loader(request.dataset, true);
  for (const fs::path& folder : scene_folders(request))
    for (BopScene& scene : loader.load(folder)) scenes.push_back(std::move(scene));
  loader.report();
  const auto place = [](const BopScene& scene) {
    return std::pair(scene.scene_id, scene.camera_name);
  };
  std::ranges::sort(scenes, {}, place);
  for (std::size_t i = 1; i < scenes.size(); ++i)
    if (place(scenes[i]) == place(scenes[i - 1]))
      throw InputError(scenes[i].folder.string(), "scene id",
                       std::to_string(scenes[i].scene_id) + " twice",
                       "scenes of different numbers");
  return scenes;
}

// A result that names no camera can belong to any of the scene's.
void require_cameras(const std::vector<BopScene>& scenes, std::span<const BopResult> results,
                     const std::string& file) {
  std::map<int, std::vector<std::string>> cameras;
  for (const BopScene& scene : scenes) cameras[scene.scene_id].push_back(scene.camera_name);
  for (const BopResult& result : results)
    if (const auto scene = cameras.find(result.scene_id);
        scene != cameras.end() && scene->second.size() > 1 && result.camera_name.empty())
      throw InputError(file, "camera", "none",
                       fmt::format("--cameras with that of the results, one of {}",
                                   fmt::join(scene->second, ", ")));
}

// The size of BOP images is only known from the images.
void read_image_sizes(BopScene& scene) {
  for (BopImage& image : scene.images) {
    const Image pixels = load_image(image.file);
    image.camera.width = pixels.width;
    image.camera.height = pixels.height;
  }
}

// Checked here, since the evaluation does not know the file's name.
void require_images(const BopScene& scene, std::span<const BopResult> results,
                    const std::string& file) {
  if (scene.truth.empty())
    throw InputError(bop_file(scene.folder, "scene_gt", scene.camera_name).string(), "ground truth",
                     "none", "the scene's true poses");
  std::set<int> ids;
  for (const BopImage& image : scene.images) ids.insert(image.image_id);
  for (const BopResult& result : results)
    if (is_of(scene, result) && !ids.contains(result.image_id))
      throw InputError(file, "im_id", std::to_string(result.image_id),
                       "an image of scene " + std::to_string(scene.scene_id));
}

// The results of the scene's images.
std::vector<BopResult> results_in(const BopScene& scene, std::span<const BopResult> results) {
  std::set<int> ids;
  for (const BopImage& image : scene.images) ids.insert(image.image_id);
  std::vector<BopResult> in_scene;
  for (const BopResult& result : results)
    if (is_of(scene, result) && ids.contains(result.image_id)) in_scene.push_back(result);
  return in_scene;
}

std::vector<EvaluationImage> load_images(const EvalRequest& request,
                                         std::span<const BopResult> results) {
  std::vector<BopScene> scenes = load_scenes(request);
  require_cameras(scenes, results, request.results);
  const EvalTargets targets(request.dataset.targets);
  std::vector<EvaluationImage> images;
  std::size_t used = 0;
  for (BopScene& scene : scenes) {
    require_images(scene, results, request.results);
    targets.restrict(scene);
    read_image_sizes(scene);
    std::size_t i = 0;
    for (EvaluationImage& image : evaluation_images(scene, results_in(scene, results))) {
      image.targets = targets.objects_of(scene, scene.images[i++].image_id);
      used += image.estimates.size();
      images.push_back(std::move(image));
    }
  }
  if (images.empty())
    throw InputError(request.dataset.targets, "targets", "none in the scenes given",
                     "at least one");
  if (used < results.size())
    log(LogLevel::Warning,
        fmt::format("{}: {} of {} results are of scenes, cameras or images not evaluated here",
                    request.results, results.size() - used, results.size()));
  return images;
}

struct Row {
  std::string object;
  Recalls recalls;
  AveragePrecision precision;
};

struct Evaluation {
  std::vector<Row> rows;   // by object, "all" last
  std::set<int> left_out;  // objects of the scenes without a model here
  int rows_without_pose = 0;
  std::ptrdiff_t images_without_depth = 0;
};

// Removes the truths and estimates of objects without a model. Returns their ids. InputError: no
// object of the scenes has a model; an estimate of an object that has no model and is not in the
// scenes.
std::set<int> leave_out_others(std::vector<EvaluationImage>& images,
                               const std::map<int, Object>& objects, const EvalRequest& request) {
  std::set<int> left_out;
  std::size_t evaluated = 0;
  for (const EvaluationImage& image : images)
    for (const BopTruth& truth : image.truth)
      if (objects.contains(truth.object_id))
        ++evaluated;
      else
        left_out.insert(truth.object_id);
  if (evaluated == 0 && !left_out.empty())
    throw InputError("command line", "--model", "none of the scenes' objects",
                     fmt::format("one of obj_id {} (--object-id gives the id of a file)",
                                 fmt::join(left_out, ", ")));
  for (EvaluationImage& image : images) {
    for (const BopResult& estimate : image.estimates)
      if (!objects.contains(estimate.object_id) && !left_out.contains(estimate.object_id))
        throw InputError(request.results, "obj_id", std::to_string(estimate.object_id),
                         "the id of a given model or of an object in the scenes");
    std::erase_if(image.truth, [&](const BopTruth& t) { return left_out.contains(t.object_id); });
    std::erase_if(image.estimates,
                  [&](const BopResult& e) { return left_out.contains(e.object_id); });
  }
  return left_out;
}

Evaluation evaluate_objects(const EvalRequest& request) {
  request.recall.validate();
  if (request.models.models.empty())
    throw InputError("command line", "--model", "none",
                     "model files, or --split for a dataset with models");
  std::map<int, Object> objects;
  for (Object& object : load_objects(request.models, EVALUATION_SYMMETRY_STEPS))
    objects[object.id] = std::move(object);
  Evaluation evaluation;
  const auto [results, rows_without_pose] = load_bop_result_rows(request.results);
  evaluation.rows_without_pose = rows_without_pose;
  std::vector<EvaluationImage> images = load_images(request, results);
  evaluation.left_out = leave_out_others(images, objects, request);
  evaluation.images_without_depth = std::ranges::count_if(
      images, [](const EvaluationImage& image) { return image.depth_file.empty(); });
  if (request.vsd && evaluation.images_without_depth == 0) {
    ThreadPool pool;
    add_vsd(images, objects, request.vsd_delta_m, pool);
  }
  const std::map<int, AveragePrecision> precisions =
      average_precisions(images, objects, request.recall, request.most_estimates);
  for (const auto& [id, recalls] : evaluate_by_object(images, objects, request.recall)) {
    const auto precision = precisions.find(id);
    evaluation.rows.push_back(
        {std::to_string(id), recalls,
         precision == precisions.end() ? AveragePrecision{} : precision->second});
  }
  evaluation.rows.push_back(
      {"all", evaluate(images, objects, request.recall), mean_over_objects(precisions)});
  return evaluation;
}

nlohmann::ordered_json row_json(const Row& row) {
  const Recalls& r = row.recalls;
  const AveragePrecision& p = row.precision;
  const auto of_vsd = [&](const auto& figure) {
    return r.has_vsd ? nlohmann::ordered_json(figure) : nlohmann::ordered_json();
  };
  return {{"images", r.images},
          {"truths", r.truths},
          {"estimates", r.estimates},
          {"ar", of_vsd(r.ar())},
          {"ar_vsd", of_vsd(r.ar_vsd)},
          {"recalls_vsd", of_vsd(r.vsd)},
          {"ar_mssd_mspd", 0.5 * (r.ar_mssd + r.ar_mspd)},
          {"ar_mssd", r.ar_mssd},
          {"ar_mspd", r.ar_mspd},
          {"recalls_mssd", r.mssd},
          {"recalls_mspd", r.mspd},
          {"ap_mssd_mspd", 0.5 * (p.ap_mssd + p.ap_mspd)},
          {"ap_mssd", p.ap_mssd},
          {"ap_mspd", p.ap_mspd},
          {"precisions_mssd", p.mssd},
          {"precisions_mspd", p.mspd},
          {"recall_pose_raw", r.recall_raw},
          {"recall_pose_symmetric", r.recall_symmetric},
          {"recall_mspd_below_max", r.recall_mspd},
          {"false_positives", r.false_positives},
          {"false_positives_per_image", r.false_positives_per_image}};
}

bool states_symmetries(const ModelArguments& models) {
  return !models.models_info.empty() || !models.symmetry.empty();
}

void save_json(const Evaluation& evaluation, const EvalRequest& request) {
  const RecallOptions& o = request.recall;
  nlohmann::ordered_json root{{"results", request.results},
                              {"scenes", request.scenes},
                              {"split", request.dataset.split},
                              {"cameras", request.dataset.cameras},
                              {"targets", request.dataset.targets},
                              {"min_visible", o.min_visible_fraction},
                              {"min_score", o.min_score},
                              {"max_angle_rad", o.max_angle_rad},
                              {"max_distance_m", o.max_distance_m},
                              {"max_mspd_px", o.max_mspd_px},
                              {"vsd_delta_m", request.vsd_delta_m},
                              {"symmetries", states_symmetries(request.models)},
                              {"objects_left_out", evaluation.left_out},
                              {"rows_without_pose", evaluation.rows_without_pose}};
  for (const Row& row : evaluation.rows)
    (row.object == "all" ? root["all"] : root["objects"][row.object]) = row_json(row);
  require_writable_folder(parent_of_output(request.json_file));
  write_file_atomically(request.json_file, json_text(root));
}

// Prints what the figures do not contain.
void print_limits(const Evaluation& evaluation, const EvalRequest& request) {
  if (!evaluation.left_out.empty())
    std::cout << fmt::format(
        "left out, truths and estimates, as they have no --model: objects {}\n",
        fmt::join(evaluation.left_out, ", "));
  if (!states_symmetries(request.models))
    std::cout << "no symmetries without --models-info or --symmetry: a pose that looks the same as "
                 "the truth "
                 "counts as a miss\n";
  const std::size_t images = static_cast<std::size_t>(evaluation.rows.back().recalls.images);
  if (request.vsd && evaluation.images_without_depth > 0)
    std::cout << fmt::format("no VSD: {} of {} images have no depth image\n",
                             evaluation.images_without_depth, images);
}

std::string words_on_ar(bool has_vsd) {
  return has_vsd ? "BOP's average recall (2019), the mean of VSD, MSSD and MSPD"
                 : "mean of BOP's average recalls MSSD and MSPD; BOP's own AR has VSD in it, which "
                   "needs depth";
}

void print_table(const std::vector<Row>& rows, const RecallOptions& o) {
  const std::string estimates = std::isinf(o.min_score)
                                    ? "all estimates"
                                    : fmt::format("estimates of score {} or more", o.min_score);
  std::cout << fmt::format(
      "{} images; truths seen by at least {:.0f} %; {}\n"
      "AR: {}\n"
      "AP: mean of BOP's average precisions (2024) MSSD and MSPD; of all: mean over the objects\n"
      "pose: below {} rad and {} mm; mspd: below {} px; fp: estimates that match no truth so, per "
      "image\n\n"
      "{:>6}{:>7}{:>10}{:>7}{:>6}{:>6}{:>6}{:>7}{:>6}{:>6}{:>7}{:>9}{:>6}{:>6}\n",
      rows.back().recalls.images, 100 * o.min_visible_fraction, estimates,
      words_on_ar(rows.back().recalls.has_vsd), o.max_angle_rad, 1000 * o.max_distance_m,
      o.max_mspd_px, "object", "truths", "estimates", "AR", "VSD", "MSSD", "MSPD", "AP", "MSSD",
      "MSPD", "pose", "pose/sym", "mspd", "fp");
  for (const auto& [object, r, p] : rows)
    std::cout << fmt::format(
        "{:>6}{:>7}{:>10}{:>7.3f}{:>6}{:>6.3f}{:>6.3f}{:>7.3f}{:>6.3f}{:>6.3f}{:>7.3f}{:>9.3f}"
        "{:>6.3f}{:>6.2f}\n",
        object, r.truths, r.estimates, r.ar(), r.has_vsd ? fmt::format("{:.3f}", r.ar_vsd) : "-",
        r.ar_mssd, r.ar_mspd, 0.5 * (p.ap_mssd + p.ap_mspd), p.ap_mssd, p.ap_mspd, r.recall_raw,
        r.recall_symmetric, r.recall_mspd, r.false_positives_per_image);
}

void run_eval(EvalRequest& request) {
  take_models_of_dataset(request.models, request.scenes, request.dataset, true);
  const bool writes_file = !request.json_file.empty();
  if (writes_file) require_writable_place(parent_of_output(request.json_file));
  const Evaluation evaluation = evaluate_objects(request);
  if (writes_file) save_json(evaluation, request);
  print_limits(evaluation, request);
  print_table(evaluation.rows, request.recall);
}

void add_options(CLI::App& verb, EvalRequest& request) {
  RecallOptions& o = request.recall;
  OptionTable(verb, "Evaluation", OptionLevel::Expert)
      .bounded("min-visible", o.min_visible_fraction, 0.0, 1.0,
               "Truths with a smaller visible fraction are ignored")
      .bounded("min-score", o.min_score, -std::numeric_limits<double>::infinity(), 1e6,
               "Estimates with a lower score are dropped")
      .bounded("max-angle", o.max_angle_rad, 1e-6, 3.2,
               "Largest angle of a right pose to the truth, rad")
      .bounded("max-distance", o.max_distance_m, 1e-9, 1.0,
               "Largest distance of a right pose from the truth, m")
      .bounded("max-mspd", o.max_mspd_px, 0.01, 10000.0, "Largest MSPD of a right pose, px")
      .bounded("max-estimates", request.most_estimates, 1, 1000000,
               "Estimates of an image that count for AP, best scores first. BOP: 100, of XYZ-IBD "
               "200")
      .flag("vsd,!--no-vsd", request.vsd, "BOP's VSD where all images have depth images (default)")
      .bounded("vsd-delta", request.vsd_delta_m, 1e-6, 1.0,
               "By how much a surface may lie behind the measured one and count as visible, m. "
               "BOP: 0.015, of ITODD 0.005");
}

}  // namespace

void add_eval(CLI::App& app, int& exit_code) {
  CLI::App* verb =
      app.add_subcommand("eval", "Compare a BOP results CSV with the ground truth of BOP scenes");
  auto request = std::make_shared<EvalRequest>();
  verb->add_option("results", request->results, "BOP results CSV")->required()->type_name("FILE");
  verb->add_option("scenes", request->scenes,
                   "BOP scenes with scene_gt.json, folders of them, or datasets with --split")
      ->required()
      ->type_name("DIR");
  add_dataset_arguments(*verb, request->dataset);
  verb->add_option(
          "--model", request->models.models,
          MESH_FORMATS + " files of the objects to evaluate; the scenes' others are left out")
      ->type_name("FILE");
  verb->add_option("--unit", request->models.unit, UNIT_HELP);
  verb->add_option(
          "--models-info", request->models.models_info,
          "BOP models_info.json with symmetries. Without it, a pose that looks the same as "
          "the truth counts as a miss")
      ->type_name("FILE");
  verb->add_option("--object-id", request->models.object_ids,
                   "BOP ids of the models; default: the number at the end of their names");
  add_symmetry(*verb, request->models.symmetry);
  verb->add_option("--json", request->json_file, "Also write the figures here")->type_name("FILE");
  add_options(*verb, *request);
  verb->callback([request, &exit_code] {
    run_eval(*request);
    exit_code = exit_done;
  });
}

}  // namespace edgescout
