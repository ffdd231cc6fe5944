// Every verb adds its subcommand and what runs it. The verb's callback may throw; only main
// catches.
#pragma once

#include <CLI/CLI.hpp>

namespace edgescout {

// `exit_code` is set by the verb that ran (exit_codes.h); it outlives the app.
void add_bench(CLI::App& app, int& exit_code);
void add_detect(CLI::App& app, int& exit_code);
void add_devices(CLI::App& app, int& exit_code);
void add_eval(CLI::App& app, int& exit_code);
void add_model(CLI::App& app, int& exit_code);
void add_register(CLI::App& app, int& exit_code);
void add_render(CLI::App& app, int& exit_code);
void add_scout(CLI::App& app, int& exit_code);

}  // namespace edgescout
