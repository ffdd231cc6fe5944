#include "host/core/options.h"

#include <algorithm>

#include "kernels/error.h"

namespace edgescout {

void BoundsCheck::require(const char* name, double found, double low, double high) const {
  if (found >= low && found <= high) return;
  std::string field = prefix_ + "." + name;
  std::ranges::replace(field, '-', '_');
  throw InputError("options", field, std::to_string(found),
                   std::to_string(low) + " to " + std::to_string(high));
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

void BoundsCheck::index(const OptionInfo& option, const Index& field,
                        std::span<const char* const> names) {
  require(option.name, field.get(), 0, double(names.size()) - 1);
}

}  // namespace edgescout
