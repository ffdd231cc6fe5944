#include "host/core/options.h"

#include <algorithm>

#include "kernels/error.h"

namespace edgescout {

void BoundsCheck::require(const char* name, double found, double low, double high) const {
  if (!(found >= low && found <= high))
    fail(name, std::to_string(found), std::to_string(low) + " to " + std::to_string(high));
}

void BoundsCheck::fail(const char* name, const std::string& found,
                       const std::string& expected) const {
  std::string field = prefix_ + "." + name;
  std::ranges::replace(field, '-', '_');
  throw InputError("options", field, found, expected);
}

void BoundsCheck::number(const OptionInfo& option, int& field, int low, int high) {
  require(option.name, field, low, high);
}

void BoundsCheck::number(const OptionInfo& option, float& field, float low, float high) {
  require(option.name, field, low, high);
}

void BoundsCheck::number(const OptionInfo& option, double& field, double low, double high) {
  require(option.name, field, low, high);
}

void BoundsCheck::range(const OptionInfo& option, Range& field, double low, double high) {
  require(option.name, field.low, low, high);
  require(option.name, field.high, field.low, high);
}

void BoundsCheck::numbers(const OptionInfo& option, std::vector<double>& field, int count,
                          double low, double high) {
  if (field.empty()) return;
  if (field.size() != std::size_t(count))
    fail(option.name, std::to_string(field.size()) + " numbers", std::to_string(count));
  for (const double number : field) require(option.name, number, low, high);
}

void BoundsCheck::index(const OptionInfo& option, const Index& field,
                        std::span<const char* const> names) {
  require(option.name, field.get(), 0, double(names.size()) - 1);
}

}  // namespace edgescout
