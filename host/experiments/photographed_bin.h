// A pile that was photographed from several places, as a bin: what can be chosen are the other
// photographs.
#pragma once

#include "host/experiments/bin.h"
#include "host/experiments/known_scene.h"
#include "host/model/template_set.h"

namespace edgescout {

// `scene`: all photographs, in the order of the views; its objects are the bin's types. Nobody
// knows how much of a part shows: all of it counts as visible. The bin's number is its first view.
// InputError where the photographs are of different cameras.
Bin photographed_bin(const KnownScene& scene, int first_view);

// For distances of 2:1 about the pile.
std::vector<TemplateSet> pile_templates(const KnownScene& scene, Backend& backend);

}  // namespace edgescout
