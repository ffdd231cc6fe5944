// What every validate() of options does: a number inside its bounds, or an error that names it.
#pragma once

#include <string>

#include "kernels/error.h"

namespace edgescout {

// Of one group of options:
//   const OptionBounds in("detect");
//   in("coarse-poses", aligned, 1, 1e6);
class OptionBounds {
 public:
  explicit OptionBounds(const char* group) : group_(group) {}
  // InputError "options: GROUP.FIELD: found FOUND, expected LOW to HIGH"; NaN is in no bounds.
  void operator()(const char* field, double found, double low, double high) const {
    if (!(found >= low && found <= high))
      throw InputError("options", std::string(group_) + "." + field, std::to_string(found),
                       std::to_string(low) + " to " + std::to_string(high));
  }

 private:
  const char* group_;
};

}  // namespace edgescout
