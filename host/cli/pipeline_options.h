// Adds the options of the pipeline and of active detection to a verb.
#pragma once

#include "host/active/scout.h"
#include "host/cli/config.h"
#include "host/pipeline.h"

namespace edgescout {

// `edge_method` receives the value of --edges, for edge_method_from_name (edge/edges.h).
void add_edge_and_tensor_options(CLI::App& verb, PipelineOptions& options,
                                 std::string& edge_method);
// The part of them that other verbs also have: the options of a tensor without lambda.
void add_tensor_value_options(CLI::App& verb, const std::string& group, TensorOptions& tensor);
// Options of a detection in single images: search, selection, restart.
void add_detection_options(CLI::App& verb, PipelineOptions& options);
// The parts of them that other verbs also have.
void add_search_options(CLI::App& verb, DetectOptions& options);
void add_hit_options(CLI::App& verb, const std::string& group, DetectOptions& options);
void add_choice_options(CLI::App& verb, double& min_probability, EdgeClaimOptions& edge_claims);
void add_template_options(CLI::App& verb, TemplateOptions& options);
// Options of the information expected of a next view, and of the belief.
void add_belief_options(CLI::App& verb, ScoutOptions& options);

}  // namespace edgescout
