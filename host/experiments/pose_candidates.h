// Poses that detection methods have to rank, the same for all of them.
#pragma once

#include <string>
#include <vector>

#include "host/eval/metrics.h"
#include "host/experiments/known_scene.h"

namespace edgescout {

struct PoseCandidate {
  Se3 camera_from_object;  // in the first image
  int instance = -1;  // index into the scene's instances of the one it is a pose of, -1 for none
};

// A candidate is a pose of an instance where it lies within twice the criterion of a correct
// registration, modulo symmetry: from there registration gets it right nearly always.
inline constexpr double CANDIDATE_ANGLE_RAD = 2 * CORRECT_ANGLE_RAD;
inline constexpr double CANDIDATE_DISTANCE_M = 2 * CORRECT_DISTANCE_M;
inline constexpr int CANDIDATES_AN_INSTANCE = 20;

// Of one type of the scene: around each of its instances CANDIDATES_AN_INSTANCE within these
// bounds, or as many as `count` leaves room for; all others anywhere in a cube that holds all
// instances, turned at random, their centres in the image. No sample of a large region would hit
// six parameters by chance: without the first there would be nothing to find.
std::vector<PoseCandidate> pose_candidates(const KnownScene& scene, int object, int count,
                                           unsigned seed);

}  // namespace edgescout
