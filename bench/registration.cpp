// Registration from given starts, against the original D2CO implementation's results on the same ones.
//
//   edgescout_bench_registration FOLDER [--device D] [--every N] [--search RAD] [--views 1|3] [--truth]
//   [--lambda L]
//
// FOLDER holds ground_truth.json, starts.csv, starts_gt.csv, cad/ and images/ (docs/evaluation.md describes
// the set). Prints the rate of correct registrations (below 0.1 rad and 5 mm) by level, quantiles of the
// errors and the time of one registration.
#include <Eigen/SVD>
#include <algorithm>
#include <chrono>
#include <cstdio>
#include <fstream>
#include <iostream>
#include <map>
#include <nlohmann/json.hpp>
#include <sstream>

#include "host/detect/observation.h"
#include "host/edge/edges.h"
#include "host/eval/metrics.h"
#include "host/io/files.h"
#include "host/io/image.h"
#include "host/io/mesh.h"
#include "host/register/refine.h"
#include "kernels/error.h"

namespace {

using namespace edgescout;
using Clock = std::chrono::steady_clock;
double seconds_since(Clock::time_point start) {
  return std::chrono::duration<double>(Clock::now() - start).count();
}

struct Arguments {
  std::string folder, device = "cpu";
  int every = 1, views = 1;
  double search_rad = 0.3, lambda = TensorOptions{}.lambda_px_per_rad;
  bool truth = false;
};

Arguments parse(int argc, char** argv) {
  Arguments a;
  for (int i = 1; i < argc; ++i) {
    const std::string word = argv[i];
    const auto next = [&] {
      if (i + 1 >= argc) throw InputError("command line", word, "nothing", "a value");
      return std::string(argv[++i]);
    };
    if (word == "--device")
      a.device = next();
    else if (word == "--every")
      a.every = std::max(1, std::stoi(next()));
    else if (word == "--views")
      a.views = std::stoi(next());
    else if (word == "--search")
      a.search_rad = std::stod(next());
    else if (word == "--lambda")
      a.lambda = std::stod(next());
    else if (word == "--truth")
      a.truth = true;
    else if (word.starts_with("--") || !a.folder.empty())
      throw InputError("command line", "argument", word,
                       "one folder, --device, --every, --views, --search, --lambda or --truth");
    else
      a.folder = word;
  }
  if (a.views != 1 && a.views != 3)
    throw InputError("command line", "--views", std::to_string(a.views), "1 or 3");
  if (a.folder.empty()) throw InputError("command line", "FOLDER", "nothing", "the folder of the starts");
  return a;
}

// Files give rotations to 12 digits in places, to 6 in others: the nearest rotation is taken. Millimetres
// become metres.
Se3 pose_of(const std::vector<double>& rotation, const std::vector<double>& translation_mm) {
  Eigen::Matrix3d r;
  for (int i = 0; i < 9; ++i) r(i / 3, i % 3) = rotation[i];
  const Eigen::JacobiSVD<Eigen::Matrix3d> svd(r, Eigen::ComputeFullU | Eigen::ComputeFullV);
  return se3_from_matrix(svd.matrixU() * svd.matrixV().transpose(),
                         1e-3 * Eigen::Vector3d(translation_mm[0], translation_mm[1], translation_mm[2]));
}

struct Scene {
  RegisterView view;
  std::map<std::string, Se3> truth;  // camera_from_object by object id
};

std::map<std::string, Scene> load_scenes(const Arguments& a, double diameter_m, Backend& backend) {
  const auto json = nlohmann::json::parse(read_file(a.folder + "/ground_truth.json"));
  std::map<std::string, Scene> scenes;
  for (const auto& entry : json["images"]) {
    const Image image = load_image(a.folder + "/" + entry["file"].get<std::string>());
    const Camera camera{entry["width"], entry["height"], entry["fx"], entry["fy"],
                        entry["cx"],    entry["cy"],     {}};
    const std::vector<EdgePoint> edges = find_edges(image, {}, backend);
    TensorOptions tensor;
    tensor.lambda_px_per_rad = float(a.lambda);
    Scene& scene = scenes[entry["name"]];
    double nearest = 1e9;
    for (const auto& object : entry["objects"]) {
      scene.truth[object["id"]] = pose_of(object["R"], object["t"]);
      nearest = std::min(nearest, scene.truth[object["id"]].translation_m.z());
    }
    scene.view = observe(image, camera, pose_of(entry["R_cam_world"], entry["t_cam_world"]), edges,
                         reduction_for(camera.fx * diameter_m / nearest), tensor, backend)
                     .view;
  }
  return scenes;
}

struct Start {
  std::string object;
  int level;
  Hypothesis camera_from_object;
};

std::map<std::string, std::vector<Start>> load_starts(const Arguments& a) {
  std::istringstream file(read_file(a.folder + (a.truth ? "/starts_gt.csv" : "/starts.csv")));
  std::map<std::string, std::vector<Start>> starts;
  std::string line, cell;
  std::getline(file, line);
  for (int row = 0; std::getline(file, line); ++row) {
    if (row % a.every != 0) continue;
    std::vector<std::string> cells;
    for (std::istringstream stream(line); std::getline(stream, cell, ',');) cells.push_back(cell);
    std::vector<double> numbers;
    for (std::size_t i = 7; i < cells.size(); ++i) numbers.push_back(std::stod(cells[i]));
    starts[cells[1]].push_back(
        {cells[2],
         std::stoi(cells[4]),
         {cells[3] == "AX-01" ? 0 : 1,
          pose_of({numbers.begin(), numbers.begin() + 9}, {numbers.begin() + 9, numbers.end()})}});
  }
  return starts;
}

// The image's own view first; with three views, the scene's others after it.
std::vector<RegisterView> views_of(const std::string& image, const std::map<std::string, Scene>& scenes,
                                   int views) {
  std::vector<RegisterView> list{scenes.at(image).view};
  if (views == 1) return list;
  for (const auto& [name, scene] : scenes)
    if (name != image && name.substr(0, 3) == image.substr(0, 3)) list.push_back(scene.view);
  return list;
}

double quantile(std::vector<double> values, double q) {
  if (values.empty()) return 0;
  std::ranges::sort(values);
  return values[std::min(values.size() - 1, std::size_t(q * values.size()))];
}

void print(const Arguments& a, const std::map<int, std::pair<int, int>>& levels,
           const std::vector<double>& mm, const std::vector<double>& rad, double seconds, int count) {
  int right = 0;
  for (const auto& [level, tally] : levels) {
    std::printf("level %d: %.1f %% of %d   ", level, 100.0 * tally.first / tally.second, tally.second);
    right += tally.first;
  }
  std::printf("all: %.1f %% of %d\n", 100.0 * right / count, count);
  std::printf(
      "%s: median %.2f mm %.4f rad, 95 %% %.2f mm %.4f rad, largest %.2f mm %.4f rad; %.2f ms a "
      "registration\n",
      a.truth ? "errors of all" : "errors of the correct ones", quantile(mm, 0.5), quantile(rad, 0.5),
      quantile(mm, 0.95), quantile(rad, 0.95), quantile(mm, 1), quantile(rad, 1), 1000 * seconds / count);
}

int run(int argc, char** argv) {
  const Arguments a = parse(argc, argv);
  const std::unique_ptr<Backend> backend = make_backend(a.device);
  const std::vector<EdgeModel> models{
      make_edge_model(load_mesh(a.folder + "/cad/AX-01.stl", LengthUnit::Millimetre)),
      make_edge_model(load_mesh(a.folder + "/cad/AX-01b.stl", LengthUnit::Millimetre))};
  const std::map<std::string, Scene> scenes = load_scenes(a, models[0].mesh.diameter_m, *backend);
  RefineOptions options;
  options.search.rotation_rad = a.search_rad;
  std::map<int, std::pair<int, int>> levels;
  std::vector<double> mm, rad;
  double seconds = 0;
  int count = 0;
  for (const auto& [image, starts] : load_starts(a)) {
    const std::vector<RegisterView> views = views_of(image, scenes, a.views);
    if (int(views.size()) < a.views) continue;
    const Se3 camera_from_world = views[0].camera_from_world;
    std::vector<Hypothesis> hypotheses;
    for (const Start& start : starts)
      hypotheses.push_back({start.camera_from_object.object,
                            inverse(camera_from_world) * start.camera_from_object.world_from_object});
    const auto begin = Clock::now();
    const std::vector<Refined> refined = refine_poses(models, hypotheses, views, *backend, options);
    seconds += seconds_since(begin);
    for (std::size_t i = 0; i < starts.size(); ++i, ++count) {
      const Se3 pose = camera_from_world * refined[i].registration.world_from_object;
      const Se3& truth = scenes.at(image).truth.at(starts[i].object);
      const PoseError error = pose_error(pose, truth, {});
      levels[starts[i].level].first += error.passes();
      ++levels[starts[i].level].second;
      if (error.passes() || a.truth) mm.push_back(1000 * error.distance_m), rad.push_back(error.angle_rad);
    }
  }
  print(a, levels, mm, rad, seconds, count);
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  try {
    return run(argc, argv);
  } catch (const std::exception& error) {
    std::cerr << "edgescout_bench_registration: error: " << error.what() << "\n";
    return 2;
  }
}
