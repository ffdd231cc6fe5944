// The models that detection looks for: from mesh files, or as templates built before.
#pragma once

#include <CLI/CLI.hpp>

#include "host/cli/inputs.h"
#include "host/model/template_set.h"

namespace edgescout {

class Backend;

// --model, --unit, --models-info, --object-id and --templates.
void add_model_arguments(CLI::App& verb, ModelArguments& arguments);

// A template file says all this itself. InputError: --templates, and beside it an option that says
// how models are read or templates are built.
void refuse_beside_templates(const CLI::App& verb);

struct KnownModels {
  std::vector<Object> objects;    // of meshes: templates must be built
  std::vector<TemplateSet> sets;  // or read
};

// InputError: neither meshes nor templates or both, one that cannot be read, an id given twice.
KnownModels load_models(const ModelArguments& arguments);

// Builds what is not built yet, saying on standard error how far it is; logs the size of every
// object and how far away it is looked for. Distances left at 0: with_default_distances for
// `camera`.
std::vector<TemplateSet> template_sets_of(const KnownModels& known, const TemplateOptions& options,
                                          const Camera& camera, Backend& backend);

}  // namespace edgescout
