// Hypothetical scenes: subsets of the object candidates that can exist together (paper, Sec. 5.2, Algorithm
// 1).
#pragma once

#include <cstdint>
#include <span>

#include "host/active/bit_matrix.h"
#include "host/register/d2co.h"

namespace edgescout {

// How far one part reaches into another: the length by which it must at least be pushed, in whatever
// direction, until no triangle of one cuts a triangle of the other and neither lies inside the other (the
// translational penetration depth). Here only the question is answered whether `penetration_m` is enough.
// Cuts and containment are decided exactly on the triangles; the directions that are tried are the normals of
// the faces in contact, which are the right ones where flat faces meet, and 42 evenly spread ones, no more
// than 22 degrees from any other: pairs said to be apart are, of the others some need as little as the given
// length to come apart, 8 % less than it at most between convex parts. Two sheets thinner than the tolerance
// pass through each other unnoticed: keep it below the thinnest wall.
inline constexpr double DEFAULT_PENETRATION_M = 0.002;

// Symmetric: candidate i with candidate j, true where they can exist together (true on the diagonal). Poses
// in any one frame.
BitMatrix plausible_pairs(std::span<const EdgeModel> models, std::span<const Hypothesis> candidates,
                          double penetration_m, ThreadPool& pool);

struct CombinationOptions {
  int count = 1000;
  std::uint64_t seed = 1;
  // a: candidates are drawn with p ~ exp(-a (1 - psi)^2); 1 is the paper's, hardly less than flat
  double sharpness = 1;
  void validate() const;
};

// Algorithm 1: for each combination K ~ Bin(N, 0.5), then K draws without replacement; a candidate that
// clashes with one drawn before is left out and costs its draw. Rows are draws: the same scene drawn twice
// stands there twice, and a scene without objects may be among them. Where all pairs clash each row has one
// candidate or none. InputError where there is no candidate.
BitMatrix sample_combinations(std::span<const double> psi, const BitMatrix& plausible,
                              const CombinationOptions& options);

}  // namespace edgescout
