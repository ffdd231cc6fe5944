// Binds options to fields, for the command line and the configuration file alike.
//
// A verb lists each field of its options structs once, with name, bounds and help. The same names
// are read from the command line (`--lambda 100`) and from a YAML file given with `--config`
// (`lambda: 100`). The command line has priority.
#pragma once

#include <CLI/CLI.hpp>
#include <set>
#include <string>
#include <utility>
#include <vector>

namespace edgescout {

// Each row binds an option to a field that holds its default. An invalid value ends the parse with
// "--NAME: found X, expected LOW to HIGH".
class OptionTable {
 public:
  // `group` is the heading of the rows in the help.
  OptionTable(CLI::App& verb, std::string group) : verb_(verb), group_(std::move(group)) {}

  // T: int, unsigned, float, double. Bounds are inclusive. NaN violates every bound.
  template <typename T>
  OptionTable& bounded(const std::string& name, T& field, T low, T high, const std::string& help);
  OptionTable& flag(const std::string& name, bool& field, const std::string& help);
  OptionTable& choice(const std::string& name, std::string& field,
                      const std::vector<std::string>& words, const std::string& help);

 private:
  CLI::App& verb_;
  std::string group_;
};

// Returns the settings to be written with a result: the verb and the rows of these groups, with the
// present values of their fields.
std::vector<std::pair<std::string, std::string>> settings_of(CLI::App& verb,
                                                             const std::set<std::string>& groups);

// Reads YAML for CLI11. Keys are names of options of the running verb or of the program. A map
// under the name of a verb has the options of that verb and is ignored when another verb runs. A
// sequence gives an option several values.
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
