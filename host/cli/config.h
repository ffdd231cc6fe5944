// One table for the command line and the configuration file.
//
// A verb lists each field of its options structs once, with name, bounds and help; the same names
// are then read from the command line
// (`--lambda 100`) and from a YAML file given with `--config` (`lambda: 100`). The command line
// wins.
#pragma once

#include <CLI/CLI.hpp>
#include <set>
#include <string>
#include <utility>
#include <vector>

namespace edgescout {

// Rows of the table: each binds an option to a field that holds its default. An unusable value ends
// the parse with "--NAME: found X, expected LOW to HIGH".
class OptionTable {
 public:
  // `group` heads the rows in the help.
  OptionTable(CLI::App& verb, std::string group) : verb_(verb), group_(std::move(group)) {}

  // T: int, unsigned, float, double. Bounds are inclusive; NaN is outside of every bound.
  template <typename T>
  OptionTable& bounded(const std::string& name, T& field, T low, T high, const std::string& help);
  OptionTable& flag(const std::string& name, bool& field, const std::string& help);
  OptionTable& choice(const std::string& name, std::string& field,
                      const std::vector<std::string>& words, const std::string& help);

 private:
  CLI::App& verb_;
  std::string group_;
};

// What a result depends on, to be written with it: the verb that made it and the rows in these
// groups, each with the value its field has now.
std::vector<std::pair<std::string, std::string>> settings_of(CLI::App& verb,
                                                             const std::set<std::string>& groups);

// YAML for CLI11. Keys are option names of the verb that runs or of the program; a map under a
// verb's name holds that verb's options and is ignored when another verb runs. Sequences give an
// option several values.
//   device: vulkan
//   detect: {lambda: 100, min-probability: 0.1}
// InputError naming file and key: no YAML, an option that does not exist.
class YamlConfig : public CLI::Config {
 public:
  explicit YamlConfig(const CLI::App& program) : program_(program) {}
  std::vector<CLI::ConfigItem> from_config(std::istream& input) const override;
  // The options of `app` and of its verb that ran, as YAML; with `default_also` those that were not
  // given too.
  std::string to_config(const CLI::App* app, bool default_also, bool write_description,
                        std::string prefix) const override;

 private:
  const CLI::App& program_;
};

// Adds `--config FILE` to the program; to be called before its verbs are added.
void add_yaml_config(CLI::App& program);

}  // namespace edgescout
