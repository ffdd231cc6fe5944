#include "host/cli/template_cache_arguments.h"

#include "commit.h"
#include "host/cli/help.h"
#include "host/cli/option_table.h"

namespace edgescout {

void add_template_cache_arguments(CLI::App& verb, TemplateCacheArguments& arguments) {
  const char* group = "Template cache";
  CLI::Option* folder = verb.add_option("--template-cache", arguments.options.folder,
                                        "Folder in which built templates are kept for later runs. "
                                        "Default: edgescout/templates in the user's cache folder");
  folder->type_name("DIR")->group(group);
  mark_expert(verb, folder);
  OptionTable(verb, group, OptionLevel::Expert)
      .flag("no-template-cache", arguments.no_cache,
            "Build all templates. Neither read nor write the folder of kept ones");
  CommandLineOptions add(verb);
  describe(arguments.options, add);
}

TemplateCache make_template_cache(const TemplateCacheArguments& arguments) {
  TemplateCacheOptions options = arguments.options;
  options.program = EDGESCOUT_COMMIT;
  if (arguments.no_cache) options.folder.clear();
  return TemplateCache(options);
}

}  // namespace edgescout
