// Adds the verbs of the program. The callback of a verb may throw; only main catches.
#pragma once

#include <CLI/CLI.hpp>

namespace edgescout {

// The verb that runs sets `exit_code` (exit_codes.h), which must outlive the app.
void add_bench(CLI::App& app, int& exit_code);
void add_camera_verb(CLI::App& app, int& exit_code);
void add_detect(CLI::App& app, int& exit_code);
void add_devices(CLI::App& app, int& exit_code);
void add_eval(CLI::App& app, int& exit_code);
void add_explain(CLI::App& app, int& exit_code);
void add_merge(CLI::App& app, int& exit_code);
void add_model(CLI::App& app, int& exit_code);
void add_register(CLI::App& app, int& exit_code);
void add_render(CLI::App& app, int& exit_code);
void add_scout(CLI::App& app, int& exit_code);
void add_track(CLI::App& app, int& exit_code);

}  // namespace edgescout
