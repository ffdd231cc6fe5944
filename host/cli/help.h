// `--help` shows the basic options of a verb, `--help-all` shows all of them.
#pragma once

#include <CLI/CLI.hpp>

namespace edgescout {

// Gives the program and its verbs both helps. Call it before the verbs are added.
void add_help(CLI::App& program);

// Leaves the option out of `--help`. Without add_help it does nothing.
void mark_expert(CLI::App& verb, const CLI::Option* option);

}  // namespace edgescout
