// The pipeline's options as rows of the table: one place for `detect` and `register`.
#pragma once

#include "host/cli/config.h"
#include "host/pipeline.h"

namespace edgescout {

// `edge_method` receives the word of --edges; edge_method_from_name (edge/edges.h) reads it.
void add_edge_and_tensor_options(CLI::App& verb, PipelineOptions& options, std::string& edge_method);
void add_detection_options(CLI::App& verb, PipelineOptions& options);
void add_template_options(CLI::App& verb, TemplateOptions& options);

}  // namespace edgescout
