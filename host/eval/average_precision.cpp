#include "host/eval/average_precision.h"

#include <algorithm>

#include "host/eval/instances.h"
#include "host/eval/matching.h"

namespace edgescout {
namespace {

struct Judged {
  double score;
  bool is_right;
};

// Adds the estimates that are not ignored.
void judge(const Instances& pair, std::span<const double> errors, double threshold,
           std::vector<Judged>& judged) {
  const std::vector<int> matched = match_in_order(errors, pair.truths, threshold);
  for (std::size_t i = 0; i < matched.size(); ++i) {
    const bool is_right = matched[i] != UNMATCHED;
    if (!is_right || pair.is_visible[static_cast<std::size_t>(matched[i])])
      judged.push_back({pair.scores[i], is_right});
  }
}

double average_precision(std::vector<Judged> judged, int truths) {
  std::ranges::stable_sort(judged, std::ranges::greater{}, &Judged::score);
  std::vector<double> recalls, precisions;
  int right = 0;
  for (const Judged& estimate : judged) {
    right += estimate.is_right;
    recalls.push_back(right / static_cast<double>(truths));
    precisions.push_back(right / static_cast<double>(recalls.size()));
  }
  for (std::size_t i = precisions.size(); i-- > 1;)
    precisions[i - 1] = std::max(precisions[i - 1], precisions[i]);
  constexpr int steps = 100;
  double sum = 0;
  for (int step = 0; step <= steps; ++step) {
    const auto reached = std::ranges::lower_bound(recalls, step * 0.01);
    if (reached != recalls.end())
      sum += precisions[static_cast<std::size_t>(reached - recalls.begin())];
  }
  return sum / (steps + 1);
}

EvaluationImage with_best_estimates(EvaluationImage image, int most) {
  std::ranges::stable_sort(image.estimates, std::ranges::greater{}, &BopResult::score);
  if (image.estimates.size() > static_cast<std::size_t>(most))
    image.estimates.resize(static_cast<std::size_t>(most));
  return image;
}

AveragePrecision of_object(std::span<const Instances> images) {
  AveragePrecision result;
  for (const Instances& pair : images)
    result.truths += static_cast<int>(std::ranges::count(pair.is_visible, 1));
  for (int step = 0; step < RECALL_STEPS && result.truths > 0; ++step) {
    std::vector<Judged> by_mssd, by_mspd;
    for (const Instances& pair : images) {
      judge(pair, pair.mssd, 0.05 * (step + 1), by_mssd);
      judge(pair, pair.mspd, pair.px_per_step * (step + 1), by_mspd);
    }
    result.mssd[step] = average_precision(std::move(by_mssd), result.truths);
    result.mspd[step] = average_precision(std::move(by_mspd), result.truths);
    result.ap_mssd += result.mssd[step] / RECALL_STEPS;
    result.ap_mspd += result.mspd[step] / RECALL_STEPS;
  }
  return result;
}

}  // namespace

std::map<int, AveragePrecision> average_precisions(std::span<const EvaluationImage> images,
                                                   const std::map<int, Object>& objects,
                                                   const RecallOptions& options,
                                                   int most_estimates) {
  options.validate();
  std::map<int, std::vector<Instances>> by_object;
  for (const EvaluationImage& image : images)
    for (Instances& pair :
         instances_of(with_best_estimates(image, most_estimates), objects, options, false))
      by_object[pair.object_id].push_back(std::move(pair));
  std::map<int, AveragePrecision> results;
  for (const auto& [id, pairs] : by_object)
    if (const AveragePrecision result = of_object(pairs); result.truths > 0) results[id] = result;
  return results;
}

AveragePrecision mean_over_objects(const std::map<int, AveragePrecision>& by_object) {
  AveragePrecision mean;
  const double objects = static_cast<double>(by_object.size());
  for (const auto& [id, of_one] : by_object) {
    mean.truths += of_one.truths;
    for (int step = 0; step < RECALL_STEPS; ++step) {
      mean.mssd[step] += of_one.mssd[step] / objects;
      mean.mspd[step] += of_one.mspd[step] / objects;
    }
    mean.ap_mssd += of_one.ap_mssd / objects;
    mean.ap_mspd += of_one.ap_mspd / objects;
  }
  return mean;
}

}  // namespace edgescout
