#include "host/core/options.h"

#include <algorithm>
#include <sstream>

#include "kernels/error.h"

namespace edgescout {

namespace {

bool is_in_metres(const std::string& help) {
  constexpr const char* unit = ", m";
  for (std::size_t at = help.find(unit); at != std::string::npos; at = help.find(unit, at + 1)) {
    const std::size_t end = at + 3;
    if (end == help.size() || std::string(".,:;").find(help[end]) != std::string::npos) return true;
  }
  return false;
}

std::string short_text(double number) {
  std::ostringstream text;
  text << number;
  return text.str();
}

}  // namespace

std::string unit_after_bounds(const std::string& help, double found, double low, double high) {
  if (!is_in_metres(help)) return "";
  const double meant_m = found / 1000;
  if (!(meant_m >= low && meant_m <= high)) return " m";
  return " m: " + short_text(found) + " mm are " + short_text(meant_m);
}

void BoundsCheck::require(const char* name, double found, double low, double high) const {
  require(OptionInfo{name, ""}, found, low, high);
}

void BoundsCheck::require(const OptionInfo& option, double found, double low, double high) const {
  if (!(found >= low && found <= high))
    fail(option.name, std::to_string(found),
         std::to_string(low) + " to " + std::to_string(high) +
             unit_after_bounds(option.help, found, low, high));
}

void BoundsCheck::fail(const char* name, const std::string& found,
                       const std::string& expected) const {
  std::string field = prefix_ + "." + name;
  std::ranges::replace(field, '-', '_');
  throw InputError("options", field, found, expected);
}

void BoundsCheck::number(const OptionInfo& option, int& field, int low, int high) {
  require(option, field, low, high);
}

void BoundsCheck::number(const OptionInfo& option, float& field, float low, float high) {
  require(option, field, low, high);
}

void BoundsCheck::number(const OptionInfo& option, double& field, double low, double high) {
  require(option, field, low, high);
}

void BoundsCheck::range(const OptionInfo& option, Range& field, double low, double high) {
  require(option, field.low, low, high);
  require(option, field.high, field.low, high);
}

void BoundsCheck::numbers(const OptionInfo& option, std::vector<double>& field, int count,
                          double low, double high) {
  if (field.empty()) return;
  if (field.size() != std::size_t(count))
    fail(option.name, std::to_string(field.size()) + " numbers", std::to_string(count));
  for (const double number : field) require(option, number, low, high);
}

void BoundsCheck::index(const OptionInfo& option, const Index& field,
                        std::span<const char* const> names) {
  require(option.name, field.get(), 0, double(names.size()) - 1);
}

}  // namespace edgescout
