// The group that a few symmetries generate.
#pragma once

#include <span>
#include <vector>

#include "host/core/se3.h"

namespace edgescout {

// Every product of the generators, the identity first; members closer than 1e-4 rad and 1e-6 m are one.
// Nothing where they are more than `most`: then they generate no finite group, or hardly one of a solid.
std::vector<Se3> generated_group(std::span<const Se3> generators, std::size_t most);

// Adds it unless the members hold it already.
void add_unless_known(std::vector<Se3>& members, const Se3& member);

}  // namespace edgescout
