// Chooses the images of a static scene that support the search of another one.
#pragma once

#include <span>
#include <vector>

#include "host/register/object_view.h"

namespace edgescout {

// At most `most` of the others, in the order given, spread evenly from the nearest camera to the
// farthest. Near cameras see the same sides of a part; far ones see what is hidden here. Every hit
// is rescored and every candidate is registered in all of them, so without a bound the work would
// grow with the square of a scene's views.
std::vector<ObjectView> support_views(const ObjectView& own, std::span<const ObjectView> others,
                                      std::size_t most);

// All images but this one, in the order given.
std::vector<ObjectView> all_but(std::span<const ObjectView> images, std::size_t own);

}  // namespace edgescout
