// Which poses of solid objects can exist together.
#pragma once

#include <span>
#include <vector>

#include "host/core/bit_matrix.h"
#include "host/register/d2co.h"

namespace edgescout {

// How far one part reaches into another: the length by which it must at least be pushed, in
// whatever direction, until no triangle of one cuts a triangle of the other and neither lies inside
// the other (the translational penetration depth). Here only the question is answered whether
// `penetration_m` is enough. Cuts and containment are decided exactly on the triangles; the
// directions that are tried are the normals of the faces in contact, which are the right ones where
// flat faces meet, and 42 evenly spread ones, no more than 22 degrees from any other: pairs said to
// be apart are, of the others some need as little as the given length to come apart, 8 % less than
// it at most between convex parts. Two sheets thinner than the tolerance pass through each other
// unnoticed: keep it below the thinnest wall.
inline constexpr double DEFAULT_PENETRATION_M = 0.002;

// Symmetric: candidate i with candidate j, true where they can exist together (true on the
// diagonal). Poses in any one frame. InputError: a penetration outside [0, 1] m.
BitMatrix plausible_pairs(std::span<const EdgeModel> models, std::span<const ObjectPose> candidates,
                          double penetration_m, ThreadPool& pool);

// What remains of the candidates' probabilities where no two of a pair that is not plausible can
// both be there: each is multiplied by the chance that nothing more probable stands where it would
// reach into. Of those, what excludes each other adds up, the rest is taken as independent;
// candidates of which all exclude each other have no more than 1 in sum.
std::vector<double> exclusive_probabilities(std::span<const double> probabilities,
                                            const BitMatrix& plausible);

}  // namespace edgescout
