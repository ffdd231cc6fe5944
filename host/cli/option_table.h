// Makes options of the command line from fields.
//
// Options of the library come from the `describe` of their struct (host/core/options.h); those of a
// verb itself are listed in an OptionTable. A YAML file takes the same names (config.h).
#pragma once

#include <CLI/CLI.hpp>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "host/core/options.h"

namespace edgescout {

// Adds each described option to a verb. The fields hold the defaults and receive the values. An
// invalid value ends the parse with "--NAME: found X, expected LOW to HIGH". A flag that is true by
// default gets "--no-NAME" as well.
//   CommandLineOptions add(verb);
//   describe(options.detect, add);
class CommandLineOptions : public OptionVisitor {
 public:
  // `group` is the heading in the help until the first call of group().
  explicit CommandLineOptions(CLI::App& verb, std::string group = "Options")
      : verb_(verb), group_(std::move(group)) {}
  void group(const char* name) override { group_ = name; }
  void number(const OptionInfo& option, int& field, int low, int high) override;
  void number(const OptionInfo& option, float& field, float low, float high) override;
  void number(const OptionInfo& option, double& field, double low, double high) override;
  void range(const OptionInfo& option, Range& field, double low, double high) override;
  void numbers(const OptionInfo& option, std::vector<double>& field, int count, double low,
               double high) override;
  void flag(const OptionInfo& option, bool& field) override;
  void off_flag(const OptionInfo& option, bool& field) override;

 private:
  void index(const OptionInfo& option, const Index& field,
             std::span<const char* const> names) override;
  CLI::App& verb_;
  std::string group_;
};

// Options of a verb itself. Each row binds an option to a field, as CommandLineOptions does.
class OptionTable {
 public:
  // `group` is the heading of the rows in the help.
  OptionTable(CLI::App& verb, std::string group, OptionLevel level = OptionLevel::Basic)
      : verb_(verb), group_(std::move(group)), level_(level) {}

  // Of the rows that follow.
  OptionTable& level(OptionLevel level);
  // T: int, unsigned, float, double. Bounds are inclusive. NaN violates every bound.
  template <typename T>
  OptionTable& bounded(const std::string& name, T& field, T low, T high, const std::string& help);
  // "shadows,!--no-shadows": the second name switches off.
  OptionTable& flag(const std::string& name, bool& field, const std::string& help);
  OptionTable& choice(const std::string& name, std::string& field,
                      const std::vector<std::string>& words, const std::string& help);

 private:
  CLI::App& verb_;
  std::string group_;
  OptionLevel level_;
};

// Returns the settings to be written with a result: the verb and the rows of these groups, with the
// present values of their fields.
std::vector<std::pair<std::string, std::string>> settings_of(CLI::App& verb,
                                                             const std::set<std::string>& groups);

}  // namespace edgescout
