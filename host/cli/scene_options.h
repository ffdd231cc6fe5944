// What a rendered scene holds and how its images look, as rows of the table: one place for `render`
// and `scout`.
#pragma once

#include "host/cli/config.h"
#include "host/render/scene.h"

namespace edgescout {

void add_scene_options(CLI::App& verb, RenderOptions& options);

}  // namespace edgescout
