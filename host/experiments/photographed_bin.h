// Makes a bin of a pile that was photographed from several places. The next view is one of the
// other photographs.
#pragma once

#include "host/experiments/bin.h"
#include "host/experiments/known_scene.h"
#include "host/model/template_set.h"

namespace edgescout {

// `scene` holds all photographs in the order of the views. Its objects are the bin's types. The
// visible fraction of a part is unknown and counts as 1. The bin's number is its first view.
// InputError: the photographs have different cameras.
Bin photographed_bin(const KnownScene& scene, int first_view);

// For a range of distances of 2:1 around the pile's distance.
std::vector<TemplateSet> pile_templates(const KnownScene& scene, Backend& backend);

}  // namespace edgescout
