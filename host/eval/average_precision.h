// Computes the average precision of detections as BOP has measured it since 2024.
//
// For each of ten thresholds, of MSSD and of MSPD, the estimates of an object are matched in each
// image, best score first, with the true poses, also with hidden ones. An estimate that took a
// hidden one (seen by less than `min_visible_fraction`) is ignored. The others of all images,
// sorted by score, give precisions and recalls. The average precision is the mean over the recalls
// 0, 0.01 .. 1 of the largest precision at that recall or a higher one. As in BOP's toolkit,
// estimates of an object that an image does not hold are not looked at.
#pragma once

#include <map>
#include <span>

#include "host/eval/recall.h"

namespace edgescout {

struct AveragePrecision {
  int truths = 0;  // that are not hidden
  std::array<double, RECALL_STEPS> mssd{}, mspd{};
  double ap_mssd = 0, ap_mspd = 0;  // mean over the thresholds
};

// Of each object that has a true pose that is not hidden. `most_estimates`: of an image only so
// many are looked at, best scores first; BOP's number is 100. InputError: as evaluate().
std::map<int, AveragePrecision> average_precisions(std::span<const EvaluationImage> images,
                                                   const std::map<int, Object>& objects,
                                                   const RecallOptions& options,
                                                   int most_estimates = 100);

// BOP's figure of a dataset: the mean over its objects. Zeros without any.
AveragePrecision mean_over_objects(const std::map<int, AveragePrecision>& by_object);

}  // namespace edgescout
