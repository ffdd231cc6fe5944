#include "host/core/symmetry_group.h"

#include <algorithm>

namespace edgescout {

namespace {

bool are_one(const Se3& a, const Se3& b, const MemberTolerance& same) {
  return angle_between_rad(a, b) < same.angle_rad && distance_between_m(a, b) < same.distance_m;
}

}  // namespace

void add_unless_known(std::vector<Se3>& members, const Se3& member, const MemberTolerance& same) {
  if (std::ranges::none_of(members, [&](const Se3& known) { return are_one(known, member, same); }))
    members.push_back(member);
}

std::vector<Se3> with_identity(std::span<const Se3> listed) {
  std::vector<Se3> members{Se3{}};
  for (const Se3& member : listed) add_unless_known(members, member);
  return members;
}

std::vector<Se3> generated_group(std::span<const Se3> generators, std::size_t most,
                                 const MemberTolerance& same) {
  std::vector<Se3> group = with_identity(generators);
  for (std::size_t i = 1; i < group.size(); ++i)
    for (const Se3& generator : generators) {
      add_unless_known(group, generator * group[i], same);
      if (group.size() > most) return {};
    }
  return group;
}

bool stand_apart(std::span<const Se3> members, const MemberTolerance& same) {
  for (std::size_t i = 0; i < members.size(); ++i)
    for (std::size_t j = 0; j < i; ++j)
      if (are_one(members[i], members[j], same)) return false;
  return true;
}

}  // namespace edgescout
