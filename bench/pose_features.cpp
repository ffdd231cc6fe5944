// Prints the training data of the probability and the rank of a pose
// (host/register/pose_classifier.h).
//
//   edgescout_bench_pose_features SCENES [--joint] [--depth] [--models FOLDER] [--set NAME]
//   [--medium N] [--all-distances | --distance-min M --distance-max M] [--device D] > poses.csv
//   scripts/fit_probability.py poses.csv...
//   scripts/fit_probability_over_views.py poses.csv...   (with --joint)
//   scripts/fit_depth.py poses.csv...                    (with --depth)
//
// SCENES is a folder of BOP scenes; FOLDER (default: SCENES/models) has models_info.json and
// obj_NNNNNN.ply in mm. NAME (default: the folder's) is the first column. Without distances the
// range is that of the true poses, a tenth wider at both ends; with --all-distances it is detect's
// default (with_default_distances). With --depth the images' depth images are used.
//
// Every image is searched for every object that it shows; with --joint all images of a scene
// together. One row per pose and view in which its features are measured:
//   stage medium:   the N (default: 200) best distinct poses after the medium stage (detect.h) of
//                   the search in one image, and all others near a true one
//   stage fine:     all poses after the fine stage; with --joint all that compete over all views
//   stage reported: what detection without a threshold of probability reports
//   stage truth:    every true pose, registered from itself without a search
// `image` is scene and searched image, or the scene alone; `pose` counts the poses of a stage in
// it. `rank`, `probability` and `explained` are of all views of the pose, the other features of the
// row's `view`. `truth` is the index of the nearest true pose of the object in scene_gt.json, -1
// where none lies within half a diameter; then `visible` is 0 and the errors are infinite.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>
#include <map>
#include <string>
#include <vector>

#include "bench/arguments.h"
#include "bench/bop_set.h"
#include "host/core/pose_error.h"
#include "host/detect/detect.h"
#include "host/detect/distinct_poses.h"
#include "host/detect/join_views.h"
#include "host/detect/support_views.h"
#include "host/io/bop.h"
#include "host/io/depth_file.h"
#include "host/io/image.h"
#include "host/pipeline.h"
#include "host/register/pose_classifier.h"
#include "host/register/thresholds.h"
#include "kernels/error.h"

namespace {

using namespace edgescout;

struct Arguments {
  bench::BopSet set;
  std::string device = "cpu";
  int medium = 200;
  bool joint = false, depth = false, all_distances = false;
  double distance_min_m = 0, distance_max_m = 0;
};

Arguments parse(int argc, char** argv) {
  Arguments a;
  bench::read_arguments(argc, argv,
                        {{"SCENES", &a.set.scenes},
                         {"--models", &a.set.models},
                         {"--set", &a.set.name},
                         {"--medium", &a.medium},
                         {"--joint", &a.joint},
                         {"--depth", &a.depth},
                         {"--all-distances", &a.all_distances},
                         {"--distance-min", &a.distance_min_m},
                         {"--distance-max", &a.distance_max_m},
                         {"--device", &a.device}});
  a.set.set_defaults();
  return a;
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
                                 const Mesh& mesh, const Camera& camera) {
  TemplateOptions options;
  options.distance_min_m = a.distance_min_m;
  options.distance_max_m = a.distance_max_m;
  if (a.all_distances) return with_default_distances({}, mesh.diameter_m, camera);
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
  const std::map<int, Symmetries> symmetries = load_symmetries(a.set.models + "/models_info.json");
  const BopImage& first = scenes.front().images.front();
  const Camera camera = bench::camera_of(first, load_image(first.file));
  std::map<int, SearchedObject> searched;
  for (const auto& [id, of_object] : symmetries) {
    const std::vector<BopTruth> truths = truths_of(scenes, id);
    if (truths.empty()) continue;
    const Object object = bench::load_object(a.set, id, of_object);
    searched.emplace(
        id, SearchedObject{object,
                           build_templates(object, template_options(a, truths, object.mesh, camera),
                                           backend)});
  }
  return searched;
}

// An image with its true poses of all objects.
struct ImageTruths {
  int image_id;
  Camera camera;
  Se3 camera_from_world;
  std::span<const BopTruth> truths;
};

// What the rows of one object in one search have in common. Poses are in the world of the images.
struct Printer {
  std::string begin;  // set, part, image or scene
  const Object& object;
  std::vector<ImageTruths> images;  // those in which the features of a pose were measured

  std::vector<std::size_t> own() const {
    std::vector<std::size_t> indices;
    for (std::size_t i = 0; i < images[0].truths.size(); ++i)
      if (images[0].truths[i].object_id == object.id) indices.push_back(i);
    return indices;
  }

  // The nearest true pose within half a diameter.
  int nearest_truth(const Se3& pose) const {
    const ImageTruths& image = images[0];
    double nearest_m = 0.5 * object.mesh.diameter_m;
    int nearest = -1;
    for (const std::size_t i : own()) {
      const double distance_m =
          pose_distance_m(image.camera_from_world * pose, image.truths[i].camera_from_object,
                          object.mesh, object.symmetries);
      if (distance_m < nearest_m) nearest_m = distance_m, nearest = int(i);
    }
    return nearest;
  }

  void print(const char* stage, std::span<const PoseEstimate> poses) const {
    for (std::size_t p = 0; p < poses.size(); ++p) {
      const int truth = nearest_truth(poses[p].world_from_object);
      for (std::size_t v = 0; v < images.size(); ++v) {
        std::printf("%s,%s,%zu,%d,%d,", begin.c_str(), stage, p, images[v].image_id, truth);
        print_errors(poses[p], truth, images[v]);
        std::printf("%.5f,%.5f,", PoseClassifier::rank(poses[p].features),
                    PoseClassifier::probability(poses[p].features));
        print_features(poses[p].features[v]);
        std::printf(",%.4f\n", poses[p].explained);
      }
    }
  }

 private:
  void print_errors(const PoseEstimate& pose, int truth, const ImageTruths& image) const {
    constexpr double inf = std::numeric_limits<double>::infinity();
    double visible = 0, mspd = inf;
    PoseError error{inf, inf};
    if (truth >= 0) {
      const BopTruth& t = image.truths[std::size_t(truth)];
      const Se3 camera_from_object = image.camera_from_world * pose.world_from_object;
      visible = t.visible_fraction;
      mspd = mspd_px(camera_from_object, t.camera_from_object, object, image.camera);
      error = pose_error(camera_from_object, t.camera_from_object, object.symmetries);
    }
    std::printf("%.3f,%.3f,%.5f,%.5f,", visible, mspd, error.angle_rad, error.distance_m);
  }

  static void print_features(const PoseFeatures& f) {
    PoseFeatures grey = f;
    grey.depth = {};
    std::printf("%.5f,%.5f,%.5f,%.5f,%.5f,%.5f,%.5f,%.0f,%.4f,%.2f,%.5f,%d,", psi_z_score(f),
                f.mean_px, unexplained_grey(f.shading), f.support.log_ratio,
                f.support.interior_log_ratio, f.support.support, f.support.best_displaced, f.points,
                f.in_image, f.length_px, PoseClassifier::log_odds(f), int(is_informative(f)));
    std::printf("%.5f,%.0f,%.0f,%.0f,%.0f", PoseClassifier::log_odds(grey), f.depth.agreeing,
                f.depth.contradicting, f.depth.hidden, f.depth.missing);
  }
};

// The best distinct poses by rank, and those near a true one.
std::vector<PoseEstimate> kept_of_medium(const std::vector<PoseEstimate>& medium,
                                         const Printer& printer, std::size_t most) {
  std::vector<Se3> poses;
  std::vector<double> keys;
  for (const PoseEstimate& pose : medium) {
    poses.push_back(pose.world_from_object);
    keys.push_back(-PoseClassifier::rank(pose.features));
  }
  const std::vector<std::size_t> order =
      best_distinct(poses, keys, printer.object.mesh, printer.object.symmetries,
                    thresholds::SAME_POSE * printer.object.mesh.diameter_m, poses.size());
  std::vector<PoseEstimate> kept;
  for (std::size_t n = 0; n < order.size(); ++n)
    if (n < most || printer.nearest_truth(poses[order[n]]) >= 0) kept.push_back(medium[order[n]]);
  return kept;
}

// Copies of one view share its edges.
std::size_t index_of(std::span<const ObjectView> views, const ObjectView& view) {
  return std::size_t(std::ranges::find(views, view.edges, &ObjectView::edges) - views.begin());
}

class Collector {
 public:
  Collector(const Arguments& arguments, Backend& backend)
      : arguments_(arguments), backend_(backend), scenes_(bench::load_scenes(arguments.set)) {
    options_.detect.min_probability = 0;
    objects_ = load_searched(arguments, scenes_, backend);
  }

  void print_all() const {
    std::puts(
        "set,part,image,stage,pose,view,truth,visible,mspd_px,angle_rad,distance_m,rank,"
        "probability,psi_z_score,mean_px,unexplained_grey,log_ratio,interior_log_ratio,support,"
        "best_displaced,points,in_image,length_px,log_odds,informative,grey_log_odds,agreeing,"
        "contradicting,hidden,missing,explained");
    for (const BopScene& scene : scenes_)
      if (arguments_.joint)
        print_scene(scene);
      else
        for (const BopImage& image : scene.images)
          if (scene.truth.contains(image.image_id)) print_image(scene, image);
  }

 private:
  ObjectView prepare(const BopImage& image, const Se3& camera_from_world) const {
    const Image pixels = load_image(image.file);
    const Camera camera = bench::camera_of(image, pixels);
    ObjectView view = prepare_view(pixels, camera, camera_from_world, backend_, options_);
    if (arguments_.depth && !image.depth_file.empty())
      add_depth(view, load_depth(image.depth_file, {}, image.depth_unit_m()), camera);
    return view;
  }

  std::string begin_of_rows(int object_id, const std::string& image) const {
    return arguments_.set.name + ',' + arguments_.set.name + '_' + std::to_string(object_id) + ',' +
           image;
  }

  void print_image(const BopScene& scene, const BopImage& image) const {
    const ObjectView prepared = prepare(image, {});
    const std::string name = std::to_string(scene.scene_id) + '/' + std::to_string(image.image_id);
    for (const auto& [id, searched] : objects_) {
      const Printer printer{
          begin_of_rows(id, name),
          searched.object,
          {{image.image_id, prepared.camera, {}, scene.truth.at(image.image_id)}}};
      if (!printer.own().empty()) print_object(searched, prepared, printer);
    }
    std::fflush(stdout);
  }

  void print_object(const SearchedObject& searched, const ObjectView& prepared,
                    const Printer& printer) const {
    DetectTrace trace;
    detect_objects(prepared, {&searched.set, 1}, backend_, options_, &trace);
    print_medium(trace.searches[0], printer);
    printer.print("fine", trace.searches[0].fine);
    printer.print("reported", selected_estimates(trace.selection));
    print_truth(searched, {&trace.view, 1}, printer);
  }

  void print_medium(const SearchTrace& search, const Printer& printer) const {
    printer.print("medium", kept_of_medium(search.medium, printer, std::size_t(arguments_.medium)));
  }

  void print_truth(const SearchedObject& searched, std::span<const ObjectView> views,
                   const Printer& printer) const {
    const ImageTruths& image = printer.images[0];
    std::vector<ObjectPose> starts;
    for (const std::size_t i : printer.own())
      starts.push_back({0, inverse(image.camera_from_world) * image.truths[i].camera_from_object});
    RefineOptions refine = options_.detect.refine;
    refine.search.rotation_rad = 0;
    printer.print("truth",
                  refine_poses({{&searched.set.model, 1}, views, backend_}, starts, refine));
  }

  void print_scene(const BopScene& scene) const {
    std::vector<ObjectView> views;
    std::vector<ImageTruths> images;
    for (const BopImage& image : scene.images) {
      if (!image.camera_from_world || !scene.truth.contains(image.image_id)) continue;
      views.push_back(prepare(image, *image.camera_from_world));
      images.push_back({image.image_id, views.back().camera, *image.camera_from_world,
                        scene.truth.at(image.image_id)});
    }
    if (views.size() < 2) return;
    for (const auto& [id, searched] : objects_) {
      const Printer printer{begin_of_rows(id, std::to_string(scene.scene_id)), searched.object,
                            images};
      if (!printer.own().empty()) print_object_jointly(searched, views, printer);
    }
    std::fflush(stdout);
  }

  // The stages of detect_jointly.
  void print_object_jointly(const SearchedObject& searched, std::vector<ObjectView> views,
                            const Printer& printer) const {
    const std::span<const TemplateSet> sets{&searched.set, 1};
    Grid<std::vector<PoseEstimate>> candidates(views.size(), 1);
    for (ObjectView& view : views) add_tensors(view, sets, backend_, options_.tensor);
    for (std::size_t v = 0; v < views.size(); ++v) {
      SearchTrace search;
      candidates(v, 0) = find_candidates({searched.set, views[v], all_but(views, v), backend_}, {},
                                         options_.detect, &search);
      print_medium(search, printer_from(printer, views, v));
    }
    const Scene scene{{&searched.set.model, 1}, views, backend_};
    SelectionTrace selection;
    join_views(scene, sets, candidates, options_.detect, &selection);
    printer.print("fine", selection.competing);
    printer.print("reported", selected_estimates(selection));
    print_truth(searched, views, printer);
  }

  // For the features of the search in view `searched`: that view first, then those that support it;
  // its camera frame is the world.
  Printer printer_from(const Printer& of_scene, std::span<const ObjectView> views,
                       std::size_t searched) const {
    const ImageTruths& own = of_scene.images[searched];
    Printer printer{of_scene.begin + '/' + std::to_string(own.image_id), of_scene.object, {own}};
    for (const ObjectView& view : support_views(views[searched], all_but(views, searched),
                                                std::size_t(options_.detect.support_views)))
      printer.images.push_back(of_scene.images[index_of(views, view)]);
    for (ImageTruths& image : printer.images)
      image.camera_from_world = image.camera_from_world * inverse(own.camera_from_world);
    return printer;
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
