// Which other images of a static scene help to search one.
#pragma once

#include <span>
#include <vector>

#include "host/detect/observation.h"

namespace edgescout {

// At most `most` of the others, in the order given: every hit is judged and every candidate
// registered in all of them, which would grow with the square of a scene's views. They are spread
// evenly from the camera that stands nearest to the farthest: near ones see the same sides of a
// part, far ones what hides it here.
std::vector<Observation> support_views(const Observation& own, std::span<const Observation> others,
                                       std::size_t most);

// All images but this one, in the order given.
std::vector<Observation> all_but(std::span<const Observation> images, std::size_t own);

}  // namespace edgescout
