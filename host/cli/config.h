// Reads options from a YAML file given with `--config`, by the names of the command line
// (`--lambda 100` is `lambda: 100`). The command line has priority.
#pragma once

#include <CLI/CLI.hpp>
#include <string>
#include <vector>

namespace edgescout {

// Reads YAML for CLI11. Keys are names of options of the running verb or of the program. A map
// under the name of a verb has the options of that verb and is ignored when another verb runs. A
// sequence gives an option several values. Former names of options are taken with a warning
// (renamed_options.h).
//   device: vulkan
//   detect: {lambda: 100, min-probability: 0.1}
// InputError naming file and key: the file is no YAML, an option does not exist.
class YamlConfig : public CLI::Config {
 public:
  explicit YamlConfig(const CLI::App& program) : program_(program) {}
  std::vector<CLI::ConfigItem> from_config(std::istream& input) const override;
  // Returns the options of `app` and of the verb that ran as YAML; with `default_also` also those
  // that were not given.
  std::string to_config(const CLI::App* app, bool default_also, bool write_description,
                        std::string prefix) const override;

 private:
  const CLI::App& program_;
};

// Adds `--config FILE` to the program. Call it before the verbs are added.
void add_yaml_config(CLI::App& program);

}  // namespace edgescout
