// Makes the poses that detection methods rank. All methods get the same ones.
#pragma once

#include <string>
#include <vector>

#include "host/core/pose_error.h"
#include "host/experiments/known_scene.h"

namespace edgescout {

struct PoseCandidate {
  Se3 camera_from_object;  // in the first image
  int instance = -1;       // index of the scene's instance that it is a pose of; -1: none
};

// A candidate is a pose of an instance if it lies within twice the criterion of a correct
// registration, modulo symmetry. From such a pose registration nearly always succeeds.
inline constexpr double CANDIDATE_ANGLE_RAD = 2 * CORRECT_ANGLE_RAD;
inline constexpr double CANDIDATE_DISTANCE_M = 2 * CORRECT_DISTANCE_M;
inline constexpr int CANDIDATES_AN_INSTANCE = 20;

// Returns `count` candidates of one type of the scene. CANDIDATES_AN_INSTANCE lie around each of
// its instances within these bounds, if `count` leaves room for them. All others lie anywhere in a
// cube that contains all instances, with random rotations and their centres in the image. The first
// kind is needed since random samples of a large region would never be near six given parameters.
std::vector<PoseCandidate> pose_candidates(const KnownScene& scene, int object, int count,
                                           unsigned seed);

}  // namespace edgescout
