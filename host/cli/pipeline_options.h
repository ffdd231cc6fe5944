// The options of pipeline and active detection as rows of the table: one place for all verbs that
// have them.
#pragma once

#include "host/active/scout.h"
#include "host/cli/config.h"
#include "host/pipeline.h"

namespace edgescout {

// `edge_method` receives the word of --edges; edge_method_from_name (edge/edges.h) reads it.
void add_edge_and_tensor_options(CLI::App& verb, PipelineOptions& options,
                                 std::string& edge_method);
// Its part that others have too: what the values of a tensor are made of beside lambda.
void add_tensor_value_options(CLI::App& verb, const std::string& group, TensorOptions& tensor);
// What a detection in single images has: the search, the choice among what it found, a second look.
void add_detection_options(CLI::App& verb, PipelineOptions& options);
// Its parts that others have too.
void add_search_options(CLI::App& verb, DetectOptions& options);
void add_hit_options(CLI::App& verb, const std::string& group, DetectOptions& options);
void add_choice_options(CLI::App& verb, double& min_probability, EdgeClaimOptions& edge_claims);
void add_template_options(CLI::App& verb, TemplateOptions& options);
// What is imagined of a next view, and what is followed from image to image.
void add_belief_options(CLI::App& verb, ScoutOptions& options);

}  // namespace edgescout
