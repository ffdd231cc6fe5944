// How many of the true instances were found, and how many finds are false: BOP's recalls and the
// paper's.
//
// Matching, per image, object and threshold: estimates in order of falling score each take the free
// truth with the smallest error below the threshold. Recall is matched truths / truths. A truth
// seen by less than `min_visible_fraction` is ignored: not finding it is no miss, finding it is no
// false positive. It can take an estimate, but for BOP's recalls.
#pragma once

#include <array>
#include <limits>
#include <map>
#include <span>
#include <vector>

#include "host/core/types.h"
#include "host/eval/metrics.h"
#include "host/io/bop.h"

namespace edgescout {

struct EvaluationImage {
  Camera camera;
  std::vector<BopTruth> truth;
  std::vector<BopResult> estimates;  // of this image
};

// A scene's images with the results that belong to them, by image_id. Results of other scenes are
// passed over. InputError: a result of this scene for an image it does not have; an image without
// truth or whose camera has no size yet.
std::vector<EvaluationImage> evaluation_images(const BopScene& scene,
                                               std::span<const BopResult> results);

struct RecallOptions {
  double min_visible_fraction = 0.1;  // BOP's
  // Estimates below it are dropped before everything. None is by default: other methods' scores may
  // be negative.
  double min_score = -std::numeric_limits<double>::infinity();
  double max_angle_rad = CORRECT_ANGLE_RAD;
  double max_distance_m = CORRECT_DISTANCE_M;
  double max_mspd_px =
      CORRECT_MSPD_PX;  // of `recall_mspd` and of a true find, whatever the image's width
  // Throws InputError naming the field and the violated bound.
  void validate() const;
};

inline constexpr int RECALL_STEPS = 10;

struct Recalls {
  int images = 0;
  int truths = 0;     // that count
  int estimates = 0;  // not below min_score
  // BOP: thresholds 5, 10 .. 50 % of the diameter (MSSD), 5, 10 .. 50 px times width / 640 (MSPD).
  // As BOP does, only as many estimates of an object as it has truths that count in the image are
  // looked at, best scores first, and ignored truths take none of them.
  std::array<double, RECALL_STEPS> mssd{};
  std::array<double, RECALL_STEPS> mspd{};
  double ar_mssd = 0;  // mean over the thresholds
  double ar_mspd = 0;
  // Over all estimates:
  double recall_raw = 0;        // angle and distance as they stand
  double recall_symmetric = 0;  // modulo the object's symmetries
  double recall_mspd = 0;       // below max_mspd_px
  int false_positives =
      0;  // estimates that match no truth below max_mspd_px, ignored truths included
  double false_positives_per_image = 0;
};

// Objects by BOP id. All recalls are 0 where there is no truth. InputError: a truth or an estimate
// of an object that is not in `objects`.
Recalls evaluate(std::span<const EvaluationImage> images, const std::map<int, Object>& objects,
                 const RecallOptions& options);

// The same over the truths and estimates of one object alone, for each object.
std::map<int, Recalls> evaluate_by_object(std::span<const EvaluationImage> images,
                                          const std::map<int, Object>& objects,
                                          const RecallOptions& options);

}  // namespace edgescout
