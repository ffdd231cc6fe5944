// The options of the template cache, the same for every verb that builds templates.
#pragma once

#include <CLI/CLI.hpp>

#include "host/model/template_cache.h"

namespace edgescout {

struct TemplateCacheArguments {
  TemplateCacheOptions options;
  bool no_cache = false;
};

// --template-cache, --no-template-cache and --template-cache-size.
void add_template_cache_arguments(CLI::App& verb, TemplateCacheArguments& arguments);

// Templates of another build of the program are not read: its code may differ.
TemplateCache make_template_cache(const TemplateCacheArguments& arguments);

}  // namespace edgescout
