// The group that a few symmetries generate.
#pragma once

#include <span>
#include <vector>

#include "host/core/se3.h"

namespace edgescout {

// How far apart two members are at most while they are one: by both measures.
struct MemberTolerance {
  double angle_rad = 1e-4, distance_m = 1e-6;  // of rounding
};

// The identity first, then what is listed, but for what repeats to rounding.
std::vector<Se3> with_identity(std::span<const Se3> listed);

// These and every product of the generators; a product that is a member already to `same` is none
// of its own. Nothing where they are more than `most`: then they generate no finite group, or
// hardly one of a solid.
std::vector<Se3> generated_group(std::span<const Se3> generators, std::size_t most,
                                 const MemberTolerance& same = {});

// Adds it unless the members hold it already.
void add_unless_known(std::vector<Se3>& members, const Se3& member,
                      const MemberTolerance& same = {});

// Whether no two members are one by this tolerance.
bool stand_apart(std::span<const Se3> members, const MemberTolerance& same);

}  // namespace edgescout
