#include "host/eval/recall.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "host/eval/instances.h"
#include "host/eval/matching.h"
#include "kernels/error.h"

namespace edgescout {
namespace {

struct Matches {
  int found = 0;    // truths that are not ignored
  int matched = 0;  // estimates, those of ignored truths included
};

Matches match(const Instances& pair, std::span<const double> errors, double threshold) {
  Matches matches;
  for (const int truth : match_in_order(errors, pair.truths, threshold)) {
    if (truth == UNMATCHED) continue;
    ++matches.matched;
    matches.found += pair.counts[static_cast<std::size_t>(truth)];
  }
  return matches;
}

// The number of truths that BOP finds. Ignored truths take no estimate. Only the n best estimates
// are used, where n is the number of truths that are not ignored.
int found_by_bop(const Instances& pair, std::span<const double> errors, double threshold) {
  std::vector<double> counting;
  for (std::size_t i = 0; i < errors.size(); ++i)
    if (pair.counts[i % pair.counts.size()]) counting.push_back(errors[i]);
  const int truths = pair.counting();
  const std::size_t looked_at =
      static_cast<std::size_t>(std::min(pair.estimates(), truths)) * truths;
  const std::vector<int> matched =
      match_in_order(std::span(counting).first(looked_at), truths, threshold);
  return static_cast<int>(matched.size() - std::ranges::count(matched, UNMATCHED));
}

void count(const Instances& pair, const RecallOptions& options, Recalls& sums) {
  for (int step = 0; step < RECALL_STEPS; ++step) {
    sums.mssd[step] += found_by_bop(pair, pair.mssd, 0.05 * (step + 1));
    sums.mspd[step] += found_by_bop(pair, pair.mspd, pair.px_per_step * (step + 1));
  }
  for (int tau = 0; tau < VSD_TAUS; ++tau)
    for (int step = 0; sums.has_vsd && step < RECALL_STEPS; ++step)
      sums.vsd[tau][step] += found_by_bop(pair, pair.vsd[tau], 0.05 * (step + 1));
  sums.recall_raw += match(pair, pair.raw, 1.0).found;
  sums.recall_symmetric += match(pair, pair.symmetric, 1.0).found;
  const Matches seen = match(pair, pair.mspd, options.max_mspd_px);
  sums.recall_mspd += seen.found;
  sums.false_positives += pair.estimates() - seen.matched;
  sums.estimates += pair.estimates();
  sums.truths += pair.counting();
}

void count_image(const EvaluationImage& image, const std::map<int, Object>& objects,
                 const RecallOptions& options, Recalls& sums) {
  for (const Instances& pair : instances_of(image, objects, options, true))
    if (image.targets.empty() || image.targets.contains(pair.object_id)) count(pair, options, sums);
}

void finish(Recalls& sums) {
  const double truths = std::max(1, sums.truths);
  for (int step = 0; step < RECALL_STEPS; ++step) {
    sums.mssd[step] /= truths;
    sums.mspd[step] /= truths;
    sums.ar_mssd += sums.mssd[step] / RECALL_STEPS;
    sums.ar_mspd += sums.mspd[step] / RECALL_STEPS;
  }
  for (auto& of_tau : sums.vsd)
    for (double& recall : of_tau) {
      recall /= truths;
      sums.ar_vsd += recall / (VSD_TAUS * RECALL_STEPS);
    }
  sums.recall_raw /= truths;
  sums.recall_symmetric /= truths;
  sums.recall_mspd /= truths;
  sums.false_positives_per_image =
      static_cast<double>(sums.false_positives) / std::max(1, sums.images);
}

void require(bool holds, const char* field, double found, const char* expected) {
  if (!holds) throw InputError("evaluation options", field, std::to_string(found), expected);
}

}  // namespace

void RecallOptions::validate() const {
  require(min_visible_fraction >= 0 && min_visible_fraction <= 1, "min_visible_fraction",
          min_visible_fraction, "[0, 1]");
  require(min_score < std::numeric_limits<double>::infinity(), "min_score", min_score,
          "a number, or -inf");
  require(max_angle_rad > 0, "max_angle_rad", max_angle_rad, "above 0");
  require(max_distance_m > 0, "max_distance_m", max_distance_m, "above 0");
  require(max_mspd_px > 0, "max_mspd_px", max_mspd_px, "above 0");
}

bool is_of(const BopScene& scene, const BopResult& result) {
  return result.scene_id == scene.scene_id &&
         (result.camera_name.empty() || result.camera_name == scene.camera_name);
}

std::vector<EvaluationImage> evaluation_images(const BopScene& scene,
                                               std::span<const BopResult> results) {
  std::map<int, EvaluationImage> by_id;
  for (const BopImage& image : scene.images) {
    const std::string name = image.file.string();
    if (!scene.truth.contains(image.image_id))
      throw InputError(scene.folder.string(), "scene_gt.json",
                       "no entry " + std::to_string(image.image_id), "the truth of " + name);
    if (image.camera.width < 1)
      throw InputError(name, "width", "none", "the image's size in its camera");
    EvaluationImage& added = by_id[image.image_id];
    added.camera = image.camera;
    added.truth = scene.truth.at(image.image_id);
    added.depth_file = image.depth_file;
    added.depth_unit_m = image.depth_unit_m();
  }
  for (const BopResult& result : results) {
    if (!is_of(scene, result)) continue;
    const auto image = by_id.find(result.image_id);
    if (image == by_id.end())
      throw InputError("results", "im_id", std::to_string(result.image_id),
                       "an image of scene " + std::to_string(scene.scene_id));
    image->second.estimates.push_back(result);
  }
  std::vector<EvaluationImage> images;
  for (auto& [id, image] : by_id) images.push_back(std::move(image));
  return images;
}

Recalls evaluate(std::span<const EvaluationImage> images, const std::map<int, Object>& objects,
                 const RecallOptions& options) {
  options.validate();
  Recalls sums;
  sums.images = static_cast<int>(images.size());
  sums.has_vsd = !images.empty() && std::ranges::all_of(images, [](const EvaluationImage& image) {
    return image.vsd.has_value();
  });
  for (const EvaluationImage& image : images) count_image(image, objects, options, sums);
  finish(sums);
  return sums;
}

std::map<int, Recalls> evaluate_by_object(std::span<const EvaluationImage> images,
                                          const std::map<int, Object>& objects,
                                          const RecallOptions& options) {
  std::map<int, Recalls> recalls;
  for (const auto& [id, object] : objects) {
    std::vector<EvaluationImage> filtered(images.begin(), images.end());
    for (EvaluationImage& image : filtered) {
      std::erase_if(image.truth, [id = id](const BopTruth& t) { return t.object_id != id; });
      std::erase_if(image.estimates, [id = id](const BopResult& e) { return e.object_id != id; });
    }
    recalls[id] = evaluate(filtered, objects, options);
  }
  return recalls;
}

}  // namespace edgescout
