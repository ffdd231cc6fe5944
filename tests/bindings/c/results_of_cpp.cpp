// What detection, joint detection, registration and the scout find in C++, as exact numbers.
// results.c prints the same by the C interface.
#include <cstdio>

#include "host/active/scout.h"
#include "host/core/pose_matrix.h"
#include "host/edgescout.h"
#include "host/io/depth_file.h"
#include "host/io/depth_registration.h"
#include "host/register/measured_depth.h"
#include "host/track/tracker.h"
#include "kernels/backend.h"
#include "tests/bindings/c/depth_values.h"
#include "tests/bindings/c/views.h"

using namespace edgescout;

namespace {

std::string examples;

void print_numbers(const char* name, std::span<const double> numbers) {
  std::printf("  %s", name);
  for (const double number : numbers) std::printf(" %a", number);
  std::printf("\n");
}

void print_pose(const char* name, const Se3& pose) {
  double rows[16];
  write_rows(pose, rows);
  print_numbers(name, rows);
}

void print_detection(const Detection& d, std::span<const TemplateSet> sets) {
  const TemplateSet& set = sets[std::size_t(d.object)];
  std::printf(" object %d id %d %s, %s\n", d.object, set.object_id, set.model.mesh.name.c_str(),
              d.convergence.c_str());
  print_pose("pose", d.world_from_object);
  const Eigen::Matrix<double, 6, 6, Eigen::RowMajor> covariance = d.covariance;
  print_numbers("covariance", {covariance.data(), 36});
  const double scores[] = {d.probability,     d.psi, d.psi_z_score, d.cost_px, d.matched_fraction,
                           d.unexplained_grey};
  print_numbers("scores", scores);
  for (const AlternativePose& other : d.alternatives) {
    print_pose("alternative", other.world_from_object);
    print_numbers("probability", {&other.probability, 1});
  }
}

void print_detections(const char* call, const Detections& found,
                      std::span<const TemplateSet> sets) {
  std::printf("%s: %zu, completion %d\n", call, found.detections.size(), int(found.completion));
  for (const StageSeconds& stage : found.stages) std::printf(" stage %s\n", stage.name.c_str());
  for (const Detection& detection : found.detections) print_detection(detection, sets);
}

TemplateSet templates_of(int part, double distance_m, int frequency, Backend& backend) {
  char name[32];
  std::snprintf(name, sizeof name, "parts/obj_%06d.ply", part);
  TemplateOptions options;
  options.distance_min_m = options.distance_max_m = distance_m;
  options.frequency = frequency;
  const Object object{part, load_mesh(examples + name, LengthUnit::Millimetre), {}};
  return build_templates(object, options, backend);
}

// The windows of scene.c.
struct Window {
  int x, y, width, height;
};
constexpr Window part_window{0, 160, 200, 210}, scout_window{150, 215, 320, 160};

Camera camera_of(const Window& window) {
  return {window.width, window.height, 700, 700, 319.5 - window.x, 239.5 - window.y};
}

Image window_of(const std::string& file, const Window& window) {
  const Image whole = load_image(examples + file);
  Image image{window.width, window.height, {}};
  for (int y = 0; y < image.height; ++y)
    for (int x = 0; x < image.width; ++x)
      image.pixels.push_back(whole.at(window.x + x, window.y + y));
  return image;
}

// The options of quick_options in scene.c.
void make_quick(DetectOptions& options) {
  options.coarse_poses = 500;
  options.medium_poses = 60;
  options.coarse_poses_joint = 200;
  options.medium_poses_joint = 40;
  options.candidates = 5;
}

PipelineOptions quick_options() {
  PipelineOptions options;
  make_quick(options.detect);
  options.detect.min_probability = 0.05;
  return options;
}

ScoutOptions quick_scout_options() {
  ScoutOptions options;
  make_quick(options.pipeline.detect);
  options.particles.count = 40;
  options.combinations.count = 100;
  options.max_searches = 1;
  return options;
}

void print_tracks(const Image& image, const Detection& best, std::span<const TemplateSet> sets,
                  Backend& backend) {
  Tracker tracker(sets, camera_of(part_window), backend);
  double rows[16];
  write_rows(best.world_from_object, rows);  // C passes matrices
  tracker.add(best.object, pose_of_rows(rows, "best"));
  const auto shared = std::make_shared<const Image>(image);
  for (int i = 1; i <= 3; ++i) {
    const Track track = tracker.update({shared, i / 30.0}).front();
    std::printf("track %d of object %d: state %d\n", track.id, track.object, int(track.state));
    print_pose("pose", track.world_from_object);
    const Eigen::Matrix<double, 6, 6, Eigen::RowMajor> covariance = track.covariance;
    print_numbers("covariance", {covariance.data(), 36});
    print_numbers("above chance", {&track.above_chance, 1});
  }
}

void print_one_view(Backend& backend) {
  const std::vector<TemplateSet> sets{templates_of(1, 0.34, 2, backend)};
  const Image image = window_of("scenes/000000/gray/000000.png", part_window);
  const ObjectView view = prepare_view(image, camera_of(part_window), Se3{}, backend, {});
  const Detections found = detect_objects(view, sets, backend, quick_options());
  print_tracks(image, found.detections.front(), sets, backend);
  print_detections("detect", found, sets);
  std::vector<ObjectPose> starts(2);
  starts[0].world_from_object.translation_m = {-0.11, 0.01, 0.33};
  starts[1].world_from_object.translation_m = {5, 0.01, 0.33};
  const std::vector<EdgeModel> models = models_of(sets);
  const RegisterObjectsOptions options;
  print_detections("register", register_objects({&view, 1}, models, starts, backend, options),
                   sets);
  RegistrationOptions other;
  other.edges.gradient.sigma_px = 1.5f;
  other.work.tensor.bins = 30;
  other.work.refine.search.num_kept = 2;
  PipelineOptions preparing;
  preparing.edges = other.edges;
  const ObjectView blurred = prepare_view(image, camera_of(part_window), Se3{}, backend, preparing);
  print_detections("register with options",
                   register_objects({&blurred, 1}, models, starts, backend, other.work), sets);
}

DepthImage depth_of(int width, int height) {
  std::vector<std::uint16_t> mm;
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) mm.push_back(std::uint16_t(depth_mm_at(x, y)));
  return depth_image(mm, width, height);
}

void print_with_depth(Backend& backend) {
  const std::vector<TemplateSet> sets{templates_of(1, 0.34, 2, backend)};
  const Image image = window_of("scenes/000000/gray/000000.png", part_window);
  const Camera camera = camera_of(part_window);
  ObjectView view = prepare_view(image, camera, Se3{}, backend, {});
  DepthNoise noise;
  noise.at_one_metre_m = 0.002;
  add_depth(view, depth_of(part_window.width, part_window.height), camera, noise);
  print_detections("detect with depth", detect_objects(view, sets, backend, quick_options()), sets);

  const DepthCamera beside{{DEPTH_WIDTH, DEPTH_HEIGHT, depth_focal_px, depth_focal_px,
                            depth_center_px[0], depth_center_px[1]},
                           pose_of_rows(camera_from_depth_rows, "depth")};
  add_depth(view,
            register_depth(depth_of(DEPTH_WIDTH, DEPTH_HEIGHT), beside, camera, backend.threads()),
            view.camera);
  std::vector<ObjectPose> starts(1);
  starts[0].world_from_object.translation_m = {-0.11, 0.01, 0.33};
  print_detections("register with a depth camera",
                   register_objects({&view, 1}, models_of(sets), starts, backend, {}), sets);
}

void print_two_views(Backend& backend) {
  const std::vector<TemplateSet> sets{templates_of(4, 0.37, 1, backend),
                                      templates_of(6, 0.37, 2, backend)};
  std::vector<Se3> poses;
  for (const auto& rows : camera_from_world_views) poses.push_back(pose_of_rows(rows, "view"));
  const Camera camera = camera_of(scout_window);
  ScoutOptions options = quick_scout_options();
  options.next_view.reachable = [](int view) { return view == 1; };
  Scout scout(sets, camera, poses, options, backend);
  std::printf("proposal: view %d\n", scout.propose()->view);
  const auto depth = std::make_shared<const MeasuredDepth>(
      MeasuredDepth{depth_of(scout_window.width, scout_window.height), {}});
  std::vector<ObjectView> views;
  for (int i = 0; i < 2; ++i) {
    const Image image =
        window_of("scenes/000001/gray/00000" + std::to_string(i) + ".png", scout_window);
    views.push_back(prepare_view(image, camera, poses[std::size_t(i)], backend, {}));
    Shot shot{image, poses[std::size_t(i)]};
    if (i == 1) shot.depth = depth;
    scout.give(i, shot);
  }
  print_detections("detect_jointly", detect_jointly(views, sets, backend, quick_options()), sets);
  views[1].depth = depth;
  print_detections("detect_jointly with depth",
                   detect_jointly(views, sets, backend, quick_options()), sets);
  std::printf("scout: %zu, completion 0\n", scout.state().detections.size());
  for (const ModeDetection& mode : scout.state().detections) {
    print_detection(mode.detection, sets);
    for (const int image : mode.supporting_images) std::printf("  supported by image %d\n", image);
  }
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 2) return 2;
  examples = std::string(argv[1]) + "/";
  const auto backend = make_cpu_backend(2);
  print_one_view(*backend);
  print_with_depth(*backend);
  print_two_views(*backend);
}
