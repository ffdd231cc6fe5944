// Adds the options of a rendered scene and its images, for the verbs `render` and `scout`.
#pragma once

#include "host/cli/config.h"
#include "host/render/scene.h"

namespace edgescout {

void add_scene_options(CLI::App& verb, RenderOptions& options);

}  // namespace edgescout
