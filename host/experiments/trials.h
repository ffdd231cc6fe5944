// Runs every registration method from starts of known distance on the same views: the work of
// experiments 2 and 3.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "host/experiments/known_scene.h"
#include "host/experiments/recorded_starts.h"
#include "host/experiments/settings.h"

namespace edgescout {

// A start and its distance from the truth, modulo symmetry. 0.1 rad corresponds to 5 mm, as in the
// paper's criterion.
struct Start {
  int number = 0;
  int instance = 0;
  double distance_rad = 0;
  Se3 camera_from_object;  // in the first image
};

inline constexpr double METRES_PER_RADIAN = 0.05;  // of a start: 5 mm per 0.1 rad
inline constexpr double FARTHEST_START_RAD = 0.4;

// Returns `count` starts around every instance of the first image, turned and shifted in random
// directions. Their distances are spread evenly over (0, FARTHEST_START_RAD].
std::vector<Start> starts_around(const KnownScene& scene, int count, unsigned seed);

// The same at a distance that suits the accuracy of the true poses of photographs: 0.1 rad, and 2 %
// of the distance from the camera.
std::vector<Start> starts_by_distance(const KnownScene& scene, int count, unsigned seed);

// Each start gets the distance of its level.
std::vector<Start> as_starts(const std::vector<RecordedStart>& recorded);

// Variance of the tensor's Gaussian over orientation, bins^2, in the library that the paper's
// authors published. It has three taps, 1/4, 1/2 and 1/4. The paper has 1.
inline constexpr float ORIGINAL_SMOOTHING = 0.5;

// A method and the number of views that it uses. "edgescout" is refine_poses with default options.
// The others are those of host/baselines, on tensors of this lambda (D2CO, DC-ICP) and smoothing
// (D2CO; absent: that of the settings).
struct Trial {
  std::string method;
  int views = 1;
  float lambda_px_per_rad = PAPER_LAMBDA_PX_PER_RAD;
  std::optional<float> smoothing_variance = {};
  // "d2co"; with values other than the paper's "d2co (lambda 30)", "d2co (smoothing 0.5)".
  std::string name() const;
};

// The columns of a table of trials:
//   set, image, object, instance, start, distance_rad, visible, method, views
//   angle_rad, distance_mm, mspd_px   errors of the registered pose
//   right     1: below 0.1 rad and 5 mm modulo symmetry
//   steps     of association or of the solve; for edgescout those of the last refinement
//   cut_off   1: the limit of the steps ended the registration
//   ms        of one registration: mean over its batch, without the tensors
std::vector<std::string> trial_columns();
// The settings of registration, for the notes of a table.
Notes trial_notes(const ExperimentSettings& settings);
// One row per start and trial. Trials of more views than the scene has are left out.
Table run_trials(const KnownScene& scene, const std::vector<Start>& starts,
                 const std::vector<Trial>& trials, const ExperimentSettings& settings,
                 Backend& backend);

}  // namespace edgescout
