// Computes how many of the true instances were found and how many estimates are false: BOP's
// recalls and the paper's.
//
// Estimates are matched per image, object and threshold: each estimate, best score first, takes the
// free truth with the smallest error below the threshold. Recall is matched truths / truths. A
// truth with a visible fraction below `min_visible_fraction` is ignored: it is neither a miss nor,
// if found, a false positive. It can take an estimate, except in BOP's recalls.
#pragma once

#include <array>
#include <filesystem>
#include <limits>
#include <map>
#include <optional>
#include <span>
#include <vector>

#include "host/core/pose_error.h"
#include "host/core/types.h"
#include "host/eval/vsd.h"
#include "host/io/bop.h"

namespace edgescout {

struct EvaluationImage {
  Camera camera;
  std::vector<BopTruth> truth;
  std::vector<BopResult> estimates;  // of this image
  // Of a list of 2019: how many instances are to be found, by object. Then the most visible ones
  // are the truths of the recalls, whatever is seen of them, and other objects are left out. Empty:
  // all objects, all truths that are seen enough.
  std::map<int, int> targets;
  std::filesystem::path depth_file;  // empty: the image has none
  double depth_unit_m = 1e-3;
  std::optional<VsdTables> vsd;  // of this image's depth (eval/vsd_tables.h)
};

// Whether a result is of this scene and, where it names one, of this camera.
bool is_of(const BopScene& scene, const BopResult& result);

// Returns the images of a scene with their results, by image_id. Results of other scenes are
// ignored. InputError: a result for an image that the scene does not have; an image without truth
// or with a camera without size.
std::vector<EvaluationImage> evaluation_images(const BopScene& scene,
                                               std::span<const BopResult> results);

struct RecallOptions {
  double min_visible_fraction = 0.1;  // BOP's
  // Estimates below it are dropped first. By default none is, since scores of other methods may be
  // negative.
  double min_score = -std::numeric_limits<double>::infinity();
  double max_angle_rad = CORRECT_ANGLE_RAD;
  double max_distance_m = CORRECT_DISTANCE_M;
  // For `recall_mspd` and for false positives; does not depend on the image's width.
  double max_mspd_px = CORRECT_MSPD_PX;
  void validate() const;  // InputError naming the field and the violated bound
};

inline constexpr int RECALL_STEPS = 10;

struct Recalls {
  int images = 0;
  int truths = 0;     // without ignored ones
  int estimates = 0;  // not below min_score
  // BOP's thresholds: 5, 10 .. 50 % of the diameter (MSSD), 5, 10 .. 50 px times width / 640
  // (MSPD). As in BOP, only the n best estimates of an object are used, where n is the number of
  // its truths in the image that are not ignored. Ignored truths take no estimate.
  std::array<double, RECALL_STEPS> mssd{};
  std::array<double, RECALL_STEPS> mspd{};
  double ar_mssd = 0;  // mean over the thresholds
  double ar_mspd = 0;
  // By tau, 5, 10 .. 50 % of the diameter, and by threshold of the error, 0.05, 0.1 .. 0.5. Zeros
  // unless all images have `vsd`.
  bool has_vsd = false;
  std::array<std::array<double, RECALL_STEPS>, VSD_TAUS> vsd{};
  double ar_vsd = 0;  // mean over both
  // BOP's average recall; without VSD that of the other two.
  double ar() const { return has_vsd ? (ar_mssd + ar_mspd + ar_vsd) / 3 : (ar_mssd + ar_mspd) / 2; }
  // Over all estimates:
  double recall_raw = 0;        // angle and distance without symmetries
  double recall_symmetric = 0;  // modulo the object's symmetries
  double recall_mspd = 0;       // below max_mspd_px
  // Estimates that match no truth below max_mspd_px, not even an ignored one.
  int false_positives = 0;
  double false_positives_per_image = 0;
};

// `objects`: by BOP id. Without truths all recalls are 0. InputError: a truth or an estimate of an
// object that is not in `objects`.
Recalls evaluate(std::span<const EvaluationImage> images, const std::map<int, Object>& objects,
                 const RecallOptions& options);

// The same for each object by itself.
std::map<int, Recalls> evaluate_by_object(std::span<const EvaluationImage> images,
                                          const std::map<int, Object>& objects,
                                          const RecallOptions& options);

}  // namespace edgescout
