// Adds the options of a rendered scene and its images, for the verbs `render` and `scout`.
#pragma once

#include "host/cli/option_table.h"
#include "host/render/scene.h"

namespace edgescout {

// `level`: of the most important ones; the rest is expert.
void add_scene_options(CLI::App& verb, RenderOptions& options, OptionLevel level);

}  // namespace edgescout
