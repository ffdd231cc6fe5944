// The verbs of `edgescout model`. Each has its own file.
#pragma once

#include <CLI/CLI.hpp>

namespace edgescout {

void add_model_build(CLI::App& model, int& exit_code);
void add_model_draw(CLI::App& model, int& exit_code);

}  // namespace edgescout
