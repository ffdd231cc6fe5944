// What was found of a bin's instances, and what was reported that is none, split by how much of an
// instance shows in the first view.
#pragma once

#include <span>

#include "host/active/scout_state.h"
#include "host/experiments/bin.h"
#include "host/experiments/known_scene.h"

namespace edgescout {

// An instance of which less than LEAST_VISIBLE shows: not finding it is no miss, finding it is not
// wrong. A pose is right below 0.1 rad and 5 mm modulo symmetry; "_px": where no vertex of it is 10
// px or more from its place in the first view. Detections, best first, each take the free instance
// they fit best. Wrong ones belong to the group of the instance that is nearest to them, ignored
// ones being highly occluded; so are all wrong ones where there is no instance.
struct Tally {
  int instances = 0;  // that count
  int correct = 0, correct_px = 0;
  int wrong = 0, wrong_px = 0;
  // instances with a particle that is right, reported or not: more cannot be found by looking again
  int followed = 0;
  int shown = 0;  // instances that some image so far shows lightly occluded
};

struct Judgement {
  Tally light, heavy;
};

// After a step. All poses in the world; `camera` and `camera_from_world` are the first view's.
Judgement judge(std::span<const BinInstance> instances, const ScoutStep& step,
                std::span<const Object> objects, const Camera& camera,
                const Se3& camera_from_world);

}  // namespace edgescout
