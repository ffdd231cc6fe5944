// Options set and shown as text, by their names: for interfaces that have no types of their own.
//
// Public header.
#pragma once

#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "host/core/options.h"

namespace edgescout {

enum class OptionType { Integer, Number, Range, Numbers, Flag, Choice };

// One option of a given struct, into which it refers.
struct OptionText {
  std::string name;  // "coarse-poses"
  std::string help, group;
  OptionLevel level = OptionLevel::Expert;
  OptionType type = OptionType::Number;
  double low = 0, high = 0;        // of a number, of each number of a range or of several
  int count = 0;                   // of Numbers, which may also be none
  std::vector<std::string> words;  // of a Choice
  std::function<std::string()> get;
  // InputError in one line naming the option, what was found and what was expected.
  std::function<void(const std::string&)> set;
};

// Lists the options that describe names, in order.
//
// The text of a number is as in C, that of a flag "true" or "false", that of a range "MIN MAX" or
// one number, that of several numbers "1 2 3". Words of a text are apart by blanks or commas.
class OptionTexts : public OptionVisitor {
 public:
  std::vector<OptionText> options;

  // `prefix` names the struct in messages: "detect".
  explicit OptionTexts(std::string prefix) : prefix_(std::move(prefix)) {}
  void group(const char* name) override { group_ = name; }
  void number(const OptionInfo& option, int& field, int low, int high) override;
  void number(const OptionInfo& option, float& field, float low, float high) override;
  void number(const OptionInfo& option, double& field, double low, double high) override;
  void range(const OptionInfo& option, Range& field, double low, double high) override;
  void numbers(const OptionInfo& option, std::vector<double>& field, int count, double low,
               double high) override;
  void flag(const OptionInfo& option, bool& field) override;
  // Adds an option whose text is that of a flag of its own meaning: "search-alone" is true where
  // the field is false.
  void off_flag(const OptionInfo& option, bool& field) override;

 private:
  void index(const OptionInfo& option, const Index& field,
             std::span<const char* const> names) override;
  OptionText& add(const OptionInfo& option, OptionType type, double low = 0, double high = 0);
  template <typename T>
  void add_number(const OptionInfo& option, OptionType type, T& field, T low, T high);
  void add_flag(const OptionInfo& option, bool& field, bool when_true);
  std::string prefix_, group_;
};

// Returns the option of this name, with dashes or underscores. InputError naming the most similar
// name: there is none.
OptionText& option_named(std::vector<OptionText>& options, const std::string& name,
                         const std::string& prefix);

}  // namespace edgescout
