#include "host/eval/vsd_tables.h"

#include <algorithm>
#include <string>

#include "host/io/depth_file.h"
#include "host/io/depth_registration.h"
#include "kernels/error.h"
#include "kernels/thread_pool.h"

namespace edgescout {
namespace {

std::string size_text(int width, int height) {
  return std::to_string(width) + "x" + std::to_string(height);
}

DepthImage measured_distances(const EvaluationImage& image) {
  DepthImage depth = load_depth(image.depth_file, {}, image.depth_unit_m);
  const Camera& camera = image.camera;
  if (depth.width != camera.width || depth.height != camera.height)
    throw InputError(image.depth_file.string(), "size", size_text(depth.width, depth.height),
                     size_text(camera.width, camera.height) + " as the image");
  if (camera.has_distortion()) depth = undistort_depth(depth, camera);
  return distances_of(depth, camera);
}

// As many of the best estimates as there are truths, in the order of Instances.
std::vector<Se3> best_poses(const EvaluationImage& image, int object_id, std::size_t most) {
  std::vector<BopResult> estimates;
  for (const BopResult& e : image.estimates)
    if (e.object_id == object_id) estimates.push_back(e);
  std::ranges::stable_sort(estimates, std::ranges::greater{}, &BopResult::score);
  std::vector<Se3> poses;
  for (const BopResult& e : estimates)
    if (poses.size() < most) poses.push_back(e.camera_from_object);
  return poses;
}

std::vector<Se3> true_poses(const EvaluationImage& image, int object_id) {
  std::vector<Se3> poses;
  for (const BopTruth& t : image.truth)
    if (t.object_id == object_id) poses.push_back(t.camera_from_object);
  return poses;
}

std::vector<VsdErrors> table_of(const EvaluationImage& image, int object_id,
                                const VsdObject& object, const DepthImage& measured,
                                double delta_m) {
  const auto seen = [&](const std::vector<Se3>& poses) {
    std::vector<DistanceWindow> windows;
    for (const Se3& pose : poses) windows.push_back(object.seen_by(image.camera, pose));
    return windows;
  };
  const std::vector<Se3> truths = true_poses(image, object_id);
  const std::vector<DistanceWindow> estimates = seen(best_poses(image, object_id, truths.size()));
  if (estimates.empty()) return {};
  const std::vector<DistanceWindow> truth_windows = seen(truths);
  std::vector<VsdErrors> errors;
  for (const DistanceWindow& estimate : estimates)
    for (const DistanceWindow& truth : truth_windows)
      errors.push_back(vsd(estimate, truth, measured, object.diameter_m(), delta_m));
  return errors;
}

}  // namespace

void add_vsd(std::span<EvaluationImage> images, const std::map<int, Object>& objects,
             double delta_m, ThreadPool& pool) {
  std::map<int, VsdObject> drawn;
  for (const auto& [id, object] : objects) drawn.try_emplace(id, object);
  pool.for_each(images.size(), [&](std::size_t i) {
    EvaluationImage& image = images[i];
    if (image.depth_file.empty()) return;
    const DepthImage measured = measured_distances(image);
    VsdTables tables;
    for (const BopTruth& truth : image.truth) {
      const auto object = drawn.find(truth.object_id);
      if (object == drawn.end())
        throw InputError("evaluation", "obj_id", std::to_string(truth.object_id),
                         "the id of a given model");
      if (!tables.contains(truth.object_id))
        tables[truth.object_id] =
            table_of(image, truth.object_id, object->second, measured, delta_m);
    }
    image.vsd = std::move(tables);
  });
}

}  // namespace edgescout
