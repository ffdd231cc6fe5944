// Checks that a numeric option lies inside its bounds. For validate() of option structs.
#pragma once

#include <string>

#include "kernels/error.h"

namespace edgescout {

// For one group of options:
//   const OptionBounds in("detect");
//   in("coarse-poses", coarse_poses, 1, 1e6);
class OptionBounds {
 public:
  explicit OptionBounds(const char* group) : group_(group) {}
  // InputError "options: GROUP.FIELD: found FOUND, expected LOW to HIGH". NaN is never inside.
  void operator()(const char* field, double found, double low, double high) const {
    if (!(found >= low && found <= high))
      throw InputError("options", std::string(group_) + "." + field, std::to_string(found),
                       std::to_string(low) + " to " + std::to_string(high));
  }

 private:
  const char* group_;
};

}  // namespace edgescout
