#include "host/core/symmetry_group.h"

#include <algorithm>

namespace edgescout {

void add_unless_known(std::vector<Se3>& members, const Se3& member) {
  const auto same = [&](const Se3& known) {
    return angle_between_rad(known, member) < 1e-4 && distance_between_m(known, member) < 1e-6;
  };
  if (std::ranges::none_of(members, same)) members.push_back(member);
}

std::vector<Se3> generated_group(std::span<const Se3> generators, std::size_t most) {
  std::vector<Se3> group{Se3{}};
  for (std::size_t i = 0; i < group.size(); ++i)
    for (const Se3& generator : generators) {
      add_unless_known(group, generator * group[i]);
      if (group.size() > most) return {};
    }
  return group;
}

}  // namespace edgescout
