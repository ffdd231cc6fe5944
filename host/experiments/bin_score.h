// Counts the instances of a bin that were found and the false positives, separately for lightly and
// highly occluded instances in the first view.
#pragma once

#include <span>

#include "host/active/scout_state.h"
#include "host/experiments/bin.h"
#include "host/experiments/known_scene.h"

namespace edgescout {

// An instance with a visible fraction below LEAST_VISIBLE is ignored: it is neither a miss nor, if
// found, a false positive. A pose is correct below 0.1 rad and 5 mm modulo symmetry; "_px": if all
// its vertices are less than 10 px from their places in the first view. Detections are matched best
// first, each with the free instance that it fits best. A false positive belongs to the group of
// the nearest instance; ignored instances count as highly occluded. Without any instance it is
// highly occluded.
struct Tally {
  int instances = 0;  // without ignored ones
  int correct = 0, correct_px = 0;
  int wrong = 0, wrong_px = 0;
  // Instances with a correct particle, reported or not: an upper bound of what more views can find.
  int followed = 0;
  int shown = 0;  // instances that some image so far shows lightly occluded
};

struct BinScore {
  Tally light, heavy;
};

// The score after a step. All poses are in the world. `camera` and `camera_from_world` are those of
// the first view.
BinScore score_bin(std::span<const BinInstance> instances, const ScoutStep& step,
                   std::span<const Object> objects, const Camera& camera,
                   const Se3& camera_from_world);

}  // namespace edgescout
