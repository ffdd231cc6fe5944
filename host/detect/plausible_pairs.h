// Decides which poses of solid objects can exist together.
#pragma once

#include <span>
#include <vector>

#include "host/core/bit_matrix.h"
#include "host/register/pose_estimate.h"
#include "host/register/scene.h"

namespace edgescout {

// How far one part may reach into another by default, m.
//
// The measure is the translational penetration depth: the shortest push, in any direction, after
// which no triangle of one part cuts a triangle of the other and neither lies inside the other.
// Only the question whether `penetration_m` is enough is answered.
//
// Cuts and containment are decided exactly on the triangles. Two sets of directions are tried: the
// normals of the faces in contact, which are the right ones where flat faces meet, and 42 evenly
// spread ones, of which one lies within 22 degrees of any direction. A pair that is called
// plausible is. A pair that is not may need as little as the given length; between convex parts at
// most 8 % less. Two sheets thinner than the tolerance pass through each other unnoticed: keep it
// below the thinnest wall.
inline constexpr double DEFAULT_PENETRATION_M = 0.002;

// Symmetric: true for candidates i and j that can exist together, and on the diagonal. Poses are in
// any one frame. InputError: a penetration outside [0, 1] m.
BitMatrix plausible_pairs(std::span<const EdgeModel> models, std::span<const ObjectPose> candidates,
                          double penetration_m, ThreadPool& pool);

// What remains of the candidates' probabilities where the two poses of a pair that is not plausible
// exclude each other. Each probability is multiplied by the probability that no more probable
// candidate is there which excludes it. Among those, the probabilities of candidates that exclude
// each other add up; others are taken as independent. Candidates that all exclude each other have a
// sum of 1 at most.
std::vector<double> exclusive_probabilities(std::span<const double> probabilities,
                                            const BitMatrix& plausible);

// PoseClassifier::probability of every pose. For poses with several informative views, what remains
// of it where they reach further than `penetration_m` into more probable ones
// (exclusive_probabilities). Poses with fewer informative views keep theirs: one view measures
// their distance too poorly. The poses must have features.
std::vector<double> probabilities_without_collisions(std::span<const EdgeModel> models,
                                                     std::span<const PoseEstimate> poses,
                                                     double penetration_m, ThreadPool& pool);

}  // namespace edgescout
