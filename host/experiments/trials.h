// Registrations from starts of known distance, by every method on the same views: the work of
// experiments 2 and 3.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "host/experiments/known_scene.h"
#include "host/experiments/recorded_starts.h"
#include "host/experiments/settings.h"

namespace edgescout {

// A start and how far from the truth it lies, of its equal ones the nearest; 0.1 rad go with 5 mm,
// as in the paper's criterion.
struct Start {
  int number = 0;
  int instance = 0;
  double distance_rad = 0;
  Se3 camera_from_object;  // in the first image
};

inline constexpr double METRES_PER_RADIAN = 0.05;  // of a start: 5 mm go with 0.1 rad
inline constexpr double FARTHEST_START_RAD = 0.4;

// `count` starts around every instance of the first image: random directions of turn and shift,
// distances spread evenly over (0, FARTHEST_START_RAD].
std::vector<Start> starts_around(const KnownScene& scene, int count, unsigned seed);

// The same as far from the truth as photographs' true poses allow to ask for: 0.1 rad and two
// hundredths of the distance from the camera.
std::vector<Start> starts_by_distance(const KnownScene& scene, int count, unsigned seed);

// At the distances of their levels.
std::vector<Start> as_starts(const std::vector<RecordedStart>& recorded);

// Variance of the tensor's Gaussian over orientation in the library that the paper's authors
// published, which has three taps, 1/4, 1/2 and 1/4, bins^2; the paper has 1.
inline constexpr float ORIGINAL_SMOOTHING = 0.5;

// A method and how many of the scene's views it uses. "edgescout" is refine_poses at its defaults;
// the others are those of host/baselines, on tensors of this lambda (D2CO, DC-ICP) and smoothing
// (D2CO; absent: that of the settings).
struct Trial {
  std::string method;
  int views = 1;
  float lambda_px_per_rad = PAPER_LAMBDA_PX_PER_RAD;
  std::optional<float> smoothing_variance = {};
  std::string name()
      const;  // "d2co", or with others than the paper's "d2co (lambda 30)", "d2co (smoothing 0.5)"
};

// Columns: set, image, object, instance, start, distance_rad, visible, method, views, angle_rad,
// distance_mm, mspd_px, right (1: below 0.1 rad and 5 mm modulo symmetry), steps (of association,
// or of the solve; of edgescout's polish), cut_off (1: the limit of these ended it), ms (of one
// registration, mean over its batch, tensors not included). Trials of more views than the scene has
// are left out.
std::vector<std::string> trial_columns();
// What the settings say of how registration is done, for the notes.
Notes trial_notes(const ExperimentSettings& settings);
Table run_trials(const KnownScene& scene, const std::vector<Start>& starts,
                 const std::vector<Trial>& trials, const ExperimentSettings& settings,
                 Backend& backend);

}  // namespace edgescout
