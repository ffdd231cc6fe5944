// Restricts a batch to the images of a BOP list of targets.
#pragma once

#include <set>
#include <string>
#include <vector>

#include "host/cli/inputs.h"
#include "host/io/bop_targets.h"

namespace edgescout {

// Returns the images that the list names, with what it wants of each (InputImage::wanted). Those
// that it names together are one group; an image of several groups comes once for each. Targets of
// scenes that are not among the images are passed over. InputError: an image of a scene that is
// among them is missing; none is left.
std::vector<InputImage> images_of_targets(const std::vector<InputImage>& images,
                                          const DatasetArguments& dataset);

// The objects that the list names; empty: it names none.
std::set<int> objects_of_targets(const std::string& file);

}  // namespace edgescout
