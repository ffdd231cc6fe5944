// Finds the points near a place: a hash of cubes.
#pragma once

#include <cstdint>
#include <unordered_map>
#include <utility>
#include <vector>

#include <Eigen/Core>

namespace edgescout {

class PointGrid {
 public:
  // No point lies below `origin` in any coordinate, or more than 2e6 cells above it. Queries
  // reach less than a cell beyond these bounds.
  PointGrid(const Eigen::Vector3d& origin, double cell) : origin_(origin), cell_(cell) {}

  void add(const Eigen::Vector3d& x, int id) {
    const Eigen::Array3i home = cell_of((x - origin_).array());
    cells_[key(home.x(), home.y(), home.z())].emplace_back(x, id);
  }

  // Calls visit(id) for the points at most `radius` from `x`.
  template <typename Visit>
  void for_each_near(const Eigen::Vector3d& x, double radius, Visit visit) const {
    const Eigen::Array3i first = cell_of((x - origin_).array() - radius),
                         last = cell_of((x - origin_).array() + radius);
    for (int i = first.x(); i <= last.x(); ++i)
      for (int j = first.y(); j <= last.y(); ++j)
        for (int k = first.z(); k <= last.z(); ++k)
          if (const auto cell = cells_.find(key(i, j, k)); cell != cells_.end())
            for (const auto& [point, id] : cell->second)
              if ((point - x).norm() <= radius) visit(id);
  }

 private:
  Eigen::Array3i cell_of(const Eigen::Array3d& from_origin) const {
    return (from_origin / cell_).floor().cast<int>();
  }
  // 21 bits hold each index, offset by one for the border.
  static std::uint64_t key(int i, int j, int k) {
    const auto part = [](int n) { return static_cast<std::uint64_t>(n + 1) & 0x1fffff; };
    return part(i) | part(j) << 21 | part(k) << 42;
  }
  Eigen::Vector3d origin_;
  double cell_;
  std::unordered_map<std::uint64_t, std::vector<std::pair<Eigen::Vector3d, int>>> cells_;
};

}  // namespace edgescout
