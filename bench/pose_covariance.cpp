// Prints the errors of registered poses beside their covariance (host/register/edge_covariance.h).
//
//   edgescout_bench_pose_covariance SCENES [--models FOLDER] [--set NAME] [--device D] > poses.csv
//   scripts/fit_covariance.py poses.csv...
//
// SCENES is a folder of BOP scenes; FOLDER (default: SCENES/models) has models_info.json and
// obj_NNNNNN.ply in mm. NAME (default: the folder's) is the first column.
//
// True poses that are at least two fifths visible are registered as in the fine stage of detection,
// from starts 2 mm and 0.03 rad off: in every single image, and in the first two, three, ... images
// of their scene together. One row per registration:
//   views, size_px   images, and the mean over them of the diameter in the image
//   visible          mean over the images
//   unknowns         6; 5 for an object with an axis, which has no error about it
//   angle_rad, distance_m, probability   of the registered pose
//   explained, common   share that edges explain, and the factor that follows from it
//   squared          squared error, normalised by the covariance that registration reports
//   dx_m .. rz_rad   the error in the frame of the first camera
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>
#include <string>
#include <vector>

#include "bench/arguments.h"
#include "bench/bop_set.h"
#include "host/core/matrix6.h"
#include "host/core/pose_error.h"
#include "host/core/random.h"
#include "host/detect/detect_options.h"
#include "host/detect/tensors.h"
#include "host/io/bop.h"
#include "host/io/image.h"
#include "host/pipeline.h"
#include "host/register/edge_covariance.h"
#include "host/register/pose_classifier.h"
#include "host/register/refine.h"
#include "kernels/error.h"

namespace {

using namespace edgescout;

constexpr double MIN_VISIBLE = 0.4;
constexpr double START_M = 0.002, START_RAD = 0.03;

struct Arguments {
  bench::BopSet set;
  std::string device = "cpu";
};

Arguments parse(int argc, char** argv) {
  Arguments a;
  bench::read_arguments(argc, argv,
                        {{"SCENES", &a.set.scenes},
                         {"--models", &a.set.models},
                         {"--set", &a.set.name},
                         {"--device", &a.device}});
  a.set.set_defaults();
  return a;
}

struct SearchedObject {
  Object object;
  EdgeModel model;

  double size_px(const Se3& camera_from_object, const Camera& camera) const {
    const double depth_m = (camera_from_object * model.center_m).z();
    return edgescout::size_px(model.mesh.diameter_m, depth_m, camera);
  }
};

std::vector<SearchedObject> load_objects(const bench::BopSet& set) {
  std::vector<SearchedObject> objects;
  for (const auto& [id, symmetries] :
       load_symmetries(set.models + "/models_info.json", EVALUATION_SYMMETRY_STEPS)) {
    const Object object = bench::load_object(set, id, symmetries);
    objects.push_back({object, make_edge_model(object.mesh)});
  }
  return objects;
}

// An instance as several images of a scene show it.
struct Instance {
  Se3 world_from_object;
  double visible = 0, size_px = 0;  // means over the images
};

struct Images {
  const BopScene& scene;
  std::span<const ObjectView> views;  // of the images from `first` on
  std::size_t first;
};

// Instances of an object that are visible enough.
std::vector<Instance> instances_in(const Images& images, const SearchedObject& searched) {
  const auto truths = [&](std::size_t view) -> const std::vector<BopTruth>& {
    return images.scene.truth.at(images.scene.images[images.first + view].image_id);
  };
  std::vector<Instance> instances;
  for (std::size_t i = 0; i < truths(0).size(); ++i) {
    if (truths(0)[i].object_id != searched.object.id) continue;
    Instance instance{inverse(images.views[0].camera_from_world) * truths(0)[i].camera_from_object};
    for (std::size_t v = 0; v < images.views.size(); ++v) {
      const BopTruth& truth = truths(v).at(i);  // a scene lists its instances in one order
      const double share = 1 / double(images.views.size());
      instance.visible += share * truth.visible_fraction;
      instance.size_px +=
          share * searched.size_px(truth.camera_from_object, images.views[v].camera);
    }
    if (instance.visible >= MIN_VISIBLE) instances.push_back(instance);
  }
  return instances;
}

struct Error {
  Vector6d error = Vector6d::Zero();                         // in the covariance's tangent
  double squared = std::numeric_limits<double>::infinity();  // normalised by the covariance
};

// From that of the equivalent true poses which the covariance makes likeliest. So the error about
// an axis of symmetry does not count.
Error error_of(const PoseEstimate& estimate, const Se3& truth, const Symmetries& symmetries) {
  Error least;
  for (const Se3& symmetry : symmetries.discrete) {
    const Vector6d error = local_coordinates(estimate.world_from_object, truth * symmetry);
    const double squared = error.dot(solve(estimate.covariance, error));
    if (squared < least.squared) least = {error, squared};
  }
  return least;
}

class Collector {
 public:
  Collector(const Arguments& arguments, Backend& backend)
      : arguments_(arguments), backend_(backend), objects_(load_objects(arguments.set)) {}

  void print_all() const {
    std::puts(
        "set,part,scene,first,views,size_px,visible,unknowns,angle_rad,distance_m,probability,"
        "explained,common,squared,dx_m,dy_m,dz_m,rx_rad,ry_rad,rz_rad");
    for (const BopScene& scene : bench::load_scenes(arguments_.set))
      for (const SearchedObject& searched : objects_) print_object(scene, searched);
  }

 private:
  void print_object(const BopScene& scene, const SearchedObject& searched) const {
    std::vector<ObjectView> views;
    for (const BopImage& image : scene.images) views.push_back(view_of(scene, image, searched));
    const std::span<const ObjectView> all(views);
    for (std::size_t i = 0; i < views.size(); ++i)
      print_registered({scene, all.subspan(i, 1), i}, searched);
    for (std::size_t count = 2; count <= views.size(); ++count)
      print_registered({scene, all.first(count), 0}, searched);
    std::fflush(stdout);
  }

  ObjectView view_of(const BopScene& scene, const BopImage& image,
                     const SearchedObject& searched) const {
    const Image pixels = load_image(image.file);
    ObjectView view =
        prepare_view(pixels, bench::camera_of(image, pixels),
                     image.camera_from_world.value_or(Se3{}), backend_, PipelineOptions{});
    double smallest_px = std::numeric_limits<double>::infinity();
    for (const BopTruth& truth : scene.truth.at(image.image_id))
      if (truth.object_id == searched.object.id)
        smallest_px =
            std::min(smallest_px, searched.size_px(truth.camera_from_object, view.camera));
    add_tensors(view, reduction_for(smallest_px), backend_, TensorOptions{});
    return view;
  }

  void print_registered(const Images& images, const SearchedObject& searched) const {
    const std::vector<Instance> instances = instances_in(images, searched);
    Random random = Random(images.scene.scene_id).split(images.first).split(images.views.size());
    std::vector<ObjectPose> starts;
    for (const Instance& instance : instances) {
      Vector6d off;
      off << START_M * random.direction(), START_RAD * random.direction();
      starts.push_back({0, retract(instance.world_from_object, off)});
    }
    const std::vector<PoseEstimate> found = refine_poses(
        {{&searched.model, 1}, images.views, backend_}, starts, DetectOptions{}.refine);
    for (std::size_t i = 0; i < found.size(); ++i)
      print_row(images, searched.object, instances[i], found[i]);
  }

  void print_row(const Images& images, const Object& object, const Instance& instance,
                 const PoseEstimate& estimate) const {
    const PoseError error =
        pose_error(estimate.world_from_object, instance.world_from_object, object.symmetries);
    const Error normalised = error_of(estimate, instance.world_from_object, object.symmetries);
    const bool has_axis = object.symmetries.discrete.size() >= EVALUATION_SYMMETRY_STEPS;
    std::printf("%s,%s_%d,%d,%zu,%zu,", arguments_.set.name.c_str(), arguments_.set.name.c_str(),
                object.id, images.scene.scene_id, images.first, images.views.size());
    std::printf("%.1f,%.3f,%d,%.5f,%.6f,%.4f,%.4f,%.4f,%.4f", instance.size_px, instance.visible,
                has_axis ? 5 : 6, error.angle_rad, error.distance_m,
                PoseClassifier::probability(estimate.features), estimate.explained,
                common_to_edges(estimate.explained), normalised.squared);
    const Eigen::Quaterniond& turn = images.views[0].camera_from_world.rotation;
    const Eigen::Vector3d moved_m = turn * normalised.error.head<3>(),
                          turned_rad = turn * normalised.error.tail<3>();
    std::printf(",%.6f,%.6f,%.6f,%.5f,%.5f,%.5f\n", moved_m.x(), moved_m.y(), moved_m.z(),
                turned_rad.x(), turned_rad.y(), turned_rad.z());
  }

  const Arguments& arguments_;
  Backend& backend_;
  std::vector<SearchedObject> objects_;
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
