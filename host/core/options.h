// Options of the product, each declared once: name, level, bounds and help.
//
// Every options struct has a function `describe(Options&, OptionVisitor&)` that names its fields in
// order. validate() checks the bounds with it, and the command line, the YAML file and the help are
// made from it.
//
// Public header.
#pragma once

#include <functional>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace edgescout {

enum class OptionLevel {
  Basic,   // what a first user needs: in --help
  Expert,  // the rest: in --help-all
};

struct OptionInfo {
  const char* name;  // as on the command line and in YAML: "coarse-poses"
  const char* help;  // one sentence, with the unit and what a special value means
  OptionLevel level = OptionLevel::Expert;
};

// The interval from which a value is drawn. Both ends belong to it.
struct Range {
  double low = 0, high = 0;
};

// Returns what a message adds to the bounds of a length whose help says that it is in metres
// ("Largest distance, m"): " m", and where `found` lies between them as millimetres, the number
// that was meant. Of another option: nothing.
std::string unit_after_bounds(const std::string& help, double found, double low, double high);

class OptionVisitor {
 public:
  virtual ~OptionVisitor() = default;
  // Begins a group, whose name heads what follows: "Detection".
  virtual void group(const char* name) = 0;
  // Names a number. Bounds are inclusive.
  virtual void number(const OptionInfo& option, int& field, int low, int high) = 0;
  virtual void number(const OptionInfo& option, float& field, float low, float high) = 0;
  virtual void number(const OptionInfo& option, double& field, double low, double high) = 0;
  // Names two numbers, the smaller one first. A single number is both ends.
  virtual void range(const OptionInfo& option, Range& field, double low, double high) = 0;
  // Names `count` numbers, or none: an empty field.
  virtual void numbers(const OptionInfo& option, std::vector<double>& field, int count, double low,
                       double high) = 0;
  virtual void flag(const OptionInfo& option, bool& field) = 0;
  // Names a flag that, given without a value, sets the field to false: "search-alone" for
  // detect_jointly.
  virtual void off_flag(const OptionInfo& option, bool& field) = 0;
  // Names a choice of one of the names, in the order of the enumerators. They must outlive the
  // visitor.
  template <typename Enum>
  void choice(const OptionInfo& option, Enum& field, std::span<const char* const> names) {
    index(option, {[&field] { return int(field); }, [&field](int i) { field = Enum(i); }}, names);
  }

 protected:
  struct Index {
    std::function<int()> get;
    std::function<void(int)> set;
  };
  virtual void index(const OptionInfo& option, const Index& field,
                     std::span<const char* const> names) = 0;
};

// InputError "options: PREFIX.NAME: found FOUND, expected LOW to HIGH" for a number out of bounds,
// NaN included, for a range whose ends are out of bounds or in the wrong order, and for a wrong
// number of numbers. PREFIX is the struct's ("detect"); the name's dashes become underscores.
class BoundsCheck : public OptionVisitor {
 public:
  explicit BoundsCheck(std::string prefix) : prefix_(std::move(prefix)) {}
  void group(const char*) override {}
  void number(const OptionInfo& option, int& field, int low, int high) override;
  void number(const OptionInfo& option, float& field, float low, float high) override;
  void number(const OptionInfo& option, double& field, double low, double high) override;
  void range(const OptionInfo& option, Range& field, double low, double high) override;
  void numbers(const OptionInfo& option, std::vector<double>& field, int count, double low,
               double high) override;
  void flag(const OptionInfo&, bool&) override {}
  void off_flag(const OptionInfo&, bool&) override {}
  // Throws the same error for a field that is no option, or for a bound that depends on another
  // field.
  void require(const char* name, double found, double low, double high) const;
  // Throws the same error in other words than those of bounds.
  [[noreturn]] void fail(const char* name, const std::string& found,
                         const std::string& expected) const;

 private:
  void index(const OptionInfo& option, const Index& field,
             std::span<const char* const> names) override;
  void require(const OptionInfo& option, double found, double low, double high) const;
  std::string prefix_;
};

// Checks the bounds of an options struct that has a `describe`.
template <typename Options>
void check_bounds(const Options& options, const char* prefix) {
  Options copy = options;  // describe binds fields that may be written
  BoundsCheck check(prefix);
  describe(copy, check);
}

}  // namespace edgescout
