// Prints the training data of the probability and the rank of a pose in one view
// (host/register/pose_classifier.h).
//
//   edgescout_bench_pose_features SCENES [--models FOLDER] [--set NAME] [--medium N]
//   [--distance-min M --distance-max M] [--device D] > poses.csv
//   scripts/fit_probability.py poses.csv...
//
// SCENES is a folder of BOP scenes; FOLDER (default: SCENES/models) has models_info.json and
// obj_NNNNNN.ply in mm. NAME (default: the folder's) is the first column. Without distances the
// range is that of the true poses, a tenth wider at both ends.
//
// Every image is searched for every object that it shows. One row per pose:
//   stage medium:   the N (default: 200) best distinct poses after the medium stage (detect.h), and
//                   all others near a true one
//   stage fine:     all poses after the fine stage
//   stage reported: what detection without a threshold of probability reports
//   stage truth:    every true pose, registered from itself without a search
// `truth` is the index of the nearest true pose of the object in scene_gt.json, -1 where none lies
// within half a diameter; then `visible` is 0 and the errors are infinite.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <limits>
#include <map>
#include <string>
#include <vector>

#include "bench/arguments.h"
#include "host/core/pose_error.h"
#include "host/detect/detect.h"
#include "host/detect/suppression.h"
#include "host/io/bop.h"
#include "host/io/image.h"
#include "host/pipeline.h"
#include "host/register/pose_classifier.h"
#include "host/register/thresholds.h"
#include "kernels/error.h"

namespace {

using namespace edgescout;
namespace fs = std::filesystem;

struct Arguments {
  std::string scenes, models, set, device = "cpu";
  int medium = 200;
  double distance_min_m = 0, distance_max_m = 0;
};

Arguments parse(int argc, char** argv) {
  Arguments a;
  bench::read_arguments(argc, argv,
                        {{"SCENES", &a.scenes},
                         {"--models", &a.models},
                         {"--set", &a.set},
                         {"--medium", &a.medium},
                         {"--distance-min", &a.distance_min_m},
                         {"--distance-max", &a.distance_max_m},
                         {"--device", &a.device}});
  if (a.scenes.empty())
    throw InputError("command line", "SCENES", "nothing", "a folder of BOP scenes");
  if (a.models.empty()) a.models = a.scenes + "/models";
  if (a.set.empty()) a.set = fs::path(a.scenes).lexically_normal().filename().string();
  return a;
}

std::vector<BopScene> load_scenes(const std::string& folder) {
  std::vector<fs::path> folders;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder))
    if (is_bop_scene(entry.path())) folders.push_back(entry.path());
  std::ranges::sort(folders);
  std::vector<BopScene> scenes;
  for (const fs::path& scene : folders) scenes.push_back(load_bop_scene(scene));
  return scenes;
}

// All true poses of one object.
std::vector<BopTruth> truths_of(std::span<const BopScene> scenes, int object_id) {
  std::vector<BopTruth> truths;
  for (const BopScene& scene : scenes)
    for (const auto& [image, list] : scene.truth)
      std::ranges::copy_if(list, std::back_inserter(truths),
                           [&](const BopTruth& t) { return t.object_id == object_id; });
  return truths;
}

TemplateOptions template_options(const Arguments& a, std::span<const BopTruth> truths,
                                 const Mesh& mesh) {
  TemplateOptions options;
  options.distance_min_m = a.distance_min_m;
  options.distance_max_m = a.distance_max_m;
  if (a.distance_min_m > 0) return options;
  const Eigen::Vector3d center_m = 0.5 * (mesh.box_min_m + mesh.box_max_m);
  const auto [nearest, farthest] = std::ranges::minmax(
      truths, {}, [&](const BopTruth& t) { return (t.camera_from_object * center_m).norm(); });
  options.distance_min_m = 0.9 * (nearest.camera_from_object * center_m).norm();
  options.distance_max_m = 1.1 * (farthest.camera_from_object * center_m).norm();
  return options;
}

struct SearchedObject {
  Object object;
  TemplateSet set;
};

std::map<int, SearchedObject> load_searched(const Arguments& a, std::span<const BopScene> scenes,
                                            Backend& backend) {
  const std::map<int, Symmetries> symmetries = load_symmetries(a.models + "/models_info.json");
  std::map<int, SearchedObject> searched;
  for (const auto& [id, of_object] : symmetries) {
    const std::vector<BopTruth> truths = truths_of(scenes, id);
    if (truths.empty()) continue;
    char name[32];
    std::snprintf(name, sizeof name, "obj_%06d.ply", id);
    const Object object{id, load_mesh(fs::path(a.models) / name, LengthUnit::Millimetre),
                        of_object};
    searched.emplace(
        id, SearchedObject{object, build_templates(object, template_options(a, truths, object.mesh),
                                                   backend)});
  }
  return searched;
}

// What the rows of one object in one image have in common.
struct Printer {
  std::string begin;  // set, part, image
  const Object& object;
  const Camera& camera;
  std::span<const BopTruth> truths;  // of all objects
  std::vector<std::size_t> own;      // indices of those of the object

  // The nearest true pose within half a diameter.
  int nearest_truth(const Se3& pose) const {
    double nearest_m = 0.5 * object.mesh.diameter_m;
    int nearest = -1;
    for (const std::size_t i : own) {
      const double distance_m =
          pose_distance_m(pose, truths[i].camera_from_object, object.mesh, object.symmetries);
      if (distance_m < nearest_m) nearest_m = distance_m, nearest = int(i);
    }
    return nearest;
  }

  void print(const char* stage, const PoseEstimate& pose) const {
    constexpr double inf = std::numeric_limits<double>::infinity();
    const int truth = nearest_truth(pose.world_from_object);
    double visible = 0, mspd = inf;
    PoseError error{inf, inf};
    if (truth >= 0) {
      const BopTruth& t = truths[std::size_t(truth)];
      visible = t.visible_fraction;
      mspd = mspd_px(pose.world_from_object, t.camera_from_object, object, camera);
      error = pose_error(pose.world_from_object, t.camera_from_object, object.symmetries);
    }
    const PoseFeatures& f = pose.features[0];
    std::printf("%s,%s,%d,%.3f,%.3f,%.5f,%.5f,", begin.c_str(), stage, truth, visible, mspd,
                error.angle_rad, error.distance_m);
    std::printf("%.5f,%.5f,%.5f,%.5f,%.5f,%.5f,%.5f,%.5f,%.5f,%.0f,%.4f,%.2f\n",
                PoseClassifier::rank(f), PoseClassifier::probability(f), psi_z_score(f), f.mean_px,
                unexplained_grey(f.shading), f.support.log_ratio, f.support.interior_log_ratio,
                f.support.support, f.support.best_displaced, f.points, f.in_image, f.length_px);
  }
};

// The best distinct poses by rank, and those near a true one.
std::vector<PoseEstimate> kept_of_medium(const std::vector<PoseEstimate>& medium,
                                         const Printer& printer, const Object& object,
                                         std::size_t most) {
  std::vector<Se3> poses;
  std::vector<double> keys;
  for (const PoseEstimate& pose : medium) {
    poses.push_back(pose.world_from_object);
    keys.push_back(-PoseClassifier::rank(pose.features));
  }
  const std::vector<std::size_t> order =
      best_distinct(poses, keys, object.mesh, object.symmetries,
                    thresholds::SAME_POSE * object.mesh.diameter_m, poses.size());
  std::vector<PoseEstimate> kept;
  for (std::size_t n = 0; n < order.size(); ++n)
    if (n < most || printer.nearest_truth(poses[order[n]]) >= 0) kept.push_back(medium[order[n]]);
  return kept;
}

class Collector {
 public:
  Collector(const Arguments& arguments, Backend& backend)
      : arguments_(arguments), backend_(backend), scenes_(load_scenes(arguments.scenes)) {
    options_.detect.min_probability = 0;
    objects_ = load_searched(arguments, scenes_, backend);
  }

  void print_all() const {
    std::puts(
        "set,part,image,stage,truth,visible,mspd_px,angle_rad,distance_m,rank,probability,"
        "psi_z_score,mean_px,unexplained_grey,log_ratio,interior_log_ratio,support,best_displaced,"
        "points,in_image,length_px");
    for (const BopScene& scene : scenes_)
      for (const BopImage& image : scene.images)
        if (const auto truth = scene.truth.find(image.image_id); truth != scene.truth.end())
          print_image(scene, image, truth->second);
  }

 private:
  void print_image(const BopScene& scene, const BopImage& image,
                   std::span<const BopTruth> truths) const {
    const Image pixels = load_image(image.file);
    Camera camera = image.camera;
    camera.width = pixels.width;
    camera.height = pixels.height;
    const ObjectView prepared = prepare_view(pixels, camera, {}, backend_, options_);
    for (const auto& [id, searched] : objects_) {
      char begin[256];
      std::snprintf(begin, sizeof begin, "%s,%s_%d,%d/%d", arguments_.set.c_str(),
                    arguments_.set.c_str(), id, scene.scene_id, image.image_id);
      Printer printer{begin, searched.object, prepared.camera, truths, {}};
      for (std::size_t i = 0; i < truths.size(); ++i)
        if (truths[i].object_id == id) printer.own.push_back(i);
      if (printer.own.empty()) continue;
      print_object(searched, prepared, printer);
    }
    std::fflush(stdout);
  }

  void print_object(const SearchedObject& searched, const ObjectView& prepared,
                    const Printer& printer) const {
    DetectTrace trace;
    detect_objects(prepared, {&searched.set, 1}, backend_, options_, &trace);
    for (const PoseEstimate& pose : kept_of_medium(trace.searches[0].medium, printer,
                                                   searched.object, std::size_t(arguments_.medium)))
      printer.print("medium", pose);
    for (const PoseEstimate& pose : trace.searches[0].fine) printer.print("fine", pose);
    for (const PoseEstimate& pose : selected_estimates(trace.selection))
      printer.print("reported", pose);
    std::vector<ObjectPose> starts;
    for (const std::size_t i : printer.own)
      starts.push_back({0, printer.truths[i].camera_from_object});
    RefineOptions refine = options_.detect.refine;
    refine.search.rotation_rad = 0;
    for (const PoseEstimate& pose :
         refine_poses({{&searched.set.model, 1}, {&trace.view, 1}, backend_}, starts, refine))
      printer.print("truth", pose);
  }

  const Arguments& arguments_;
  Backend& backend_;
  PipelineOptions options_;
  std::vector<BopScene> scenes_;
  std::map<int, SearchedObject> objects_;
};

}  // namespace

int main(int argc, char** argv) {
  try {
    const Arguments arguments = parse(argc, argv);
    const auto backend = make_backend(arguments.device);
    Collector(arguments, *backend).print_all();
    return 0;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "%s: %s\n", argv[0], error.what());
    return 2;
  }
}
