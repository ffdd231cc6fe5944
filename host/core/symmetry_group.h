// Builds the group that a few symmetries generate.
#pragma once

#include <span>
#include <vector>

#include "host/core/se3.h"

namespace edgescout {

// Two members within both tolerances are equal. The defaults allow for rounding.
struct MemberTolerance {
  double angle_rad = 1e-4, distance_m = 1e-6;
};

// The identity first, then the listed members without repetitions (to rounding).
std::vector<Se3> with_identity(std::span<const Se3> listed);

// The generators and all their products, without members that are equal by `same`. Empty where
// there are more than `most`: then the generators have no finite group, or none of a solid.
std::vector<Se3> generated_group(std::span<const Se3> generators, std::size_t most,
                                 const MemberTolerance& same = {});

// Adds a member unless an equal one is there.
void add_unless_known(std::vector<Se3>& members, const Se3& member,
                      const MemberTolerance& same = {});

// Whether no two members are equal by this tolerance.
bool stand_apart(std::span<const Se3> members, const MemberTolerance& same);

}  // namespace edgescout
