#include "host/eval/instances.h"

#include <algorithm>
#include <numeric>
#include <string>

#include "host/core/pose_error.h"
#include "kernels/error.h"

namespace edgescout {
namespace {

const Object& object_of(const std::map<int, Object>& objects, int id) {
  const auto found = objects.find(id);
  if (found == objects.end())
    throw InputError("evaluation", "obj_id", std::to_string(id), "the id of a given model");
  return found->second;
}

// The most visible truths, as many as the target asks for.
std::vector<char> most_visible(const std::vector<BopTruth>& truth, int instances) {
  std::vector<std::size_t> order(truth.size());
  std::iota(order.begin(), order.end(), 0);
  std::ranges::stable_sort(order, std::ranges::greater{},
                           [&](std::size_t i) { return truth[i].visible_fraction; });
  std::vector<char> chosen(truth.size(), 0);
  for (std::size_t i = 0; i < truth.size() && static_cast<int>(i) < instances; ++i)
    chosen[order[i]] = 1;
  return chosen;
}

struct OfObject {
  std::vector<BopTruth> truth;
  std::vector<BopResult> estimates;
};

void add_pose_errors(Instances& pair, const OfObject& given, const Symmetries& symmetries,
                     const RecallOptions& o) {
  for (const BopResult& e : given.estimates)
    for (const BopTruth& t : given.truth) {
      const auto error_with = [&](const Symmetries& group) {
        return pose_error(e.camera_from_object, t.camera_from_object, group, o.max_angle_rad,
                          o.max_distance_m)
            .of_bounds(o.max_angle_rad, o.max_distance_m);
      };
      pair.raw.push_back(error_with(Symmetries{}));
      pair.symmetric.push_back(error_with(symmetries));
    }
}

void add_vsd_errors(Instances& pair, const EvaluationImage& image) {
  if (!image.vsd) return;
  const auto table = image.vsd->find(pair.object_id);
  if (table == image.vsd->end()) return;
  for (const VsdErrors& errors : table->second)
    for (int tau = 0; tau < VSD_TAUS; ++tau) pair.vsd[tau].push_back(errors[tau]);
}

Instances compare(const Object& object, const EvaluationImage& image, const OfObject& given,
                  const RecallOptions& options) {
  Instances pair;
  pair.object_id = object.id;
  pair.truths = static_cast<int>(given.truth.size());
  pair.px_per_step = 5.0 * image.camera.width / 640.0;
  for (const BopTruth& t : given.truth)
    pair.is_visible.push_back(t.visible_fraction >= options.min_visible_fraction);
  const auto target = image.targets.find(object.id);
  pair.counts =
      target == image.targets.end() ? pair.is_visible : most_visible(given.truth, target->second);
  for (const BopResult& e : given.estimates) {
    pair.scores.push_back(e.score);
    for (const BopTruth& t : given.truth) {
      pair.mssd.push_back(mssd_m(e.camera_from_object, t.camera_from_object, object) /
                          object.mesh.diameter_m);
      pair.mspd.push_back(
          mspd_px(e.camera_from_object, t.camera_from_object, object, image.camera));
    }
  }
  add_vsd_errors(pair, image);
  return pair;
}

}  // namespace

int Instances::counting() const { return static_cast<int>(std::ranges::count(counts, 1)); }

std::vector<Instances> instances_of(const EvaluationImage& image,
                                    const std::map<int, Object>& objects,
                                    const RecallOptions& options, bool of_poses) {
  std::map<int, OfObject> by_object;
  for (const BopTruth& t : image.truth) by_object[t.object_id].truth.push_back(t);
  for (const BopResult& e : image.estimates)
    if (e.score >= options.min_score) by_object[e.object_id].estimates.push_back(e);
  std::vector<Instances> all;
  for (auto& [id, given] : by_object) {
    const Object& object = object_of(objects, id);
    std::ranges::stable_sort(given.estimates, std::ranges::greater{}, &BopResult::score);
    all.push_back(compare(object, image, given, options));
    if (of_poses) add_pose_errors(all.back(), given, object.symmetries, options);
  }
  return all;
}

}  // namespace edgescout
