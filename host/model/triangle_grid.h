// Finds the triangles of a mesh near a place: a grid of cubes.
#pragma once

#include <array>
#include <optional>
#include <span>
#include <vector>

#include <Eigen/Core>

namespace edgescout {

class TriangleGrid {
 public:
  using Triangle = std::array<Eigen::Vector3d, 3>;

  // Queries may ask for triangles up to `reach_m` away, above 0.
  TriangleGrid(std::vector<Triangle> triangles, double reach_m);

  // Calls visit(triangle) for all triangles within `reach_m` of `x`, and for others near it.
  template <typename Visit>
  void for_each_near(const Eigen::Vector3d& x, Visit visit) const {
    if (const auto cell = cell_of(x))
      for (std::size_t i = first_[*cell]; i < first_[*cell + 1]; ++i) visit(in_cells_[i]);
  }

  // Whether the surface passes within `distance_m` of `x`, at most `reach_m`.
  bool is_within(const Eigen::Vector3d& x, double distance_m) const;
  const Triangle& triangle(int index) const { return triangles_[index]; }

 private:
  std::optional<std::size_t> cell_of(const Eigen::Vector3d& x) const;  // none: far from all
  template <typename Visit>
  void for_each_cell(const Triangle& triangle, Visit visit) const;

  std::vector<Triangle> triangles_;
  double reach_m_, cell_m_ = 0;
  Eigen::Vector3d origin_;
  Eigen::Array3i cells_;
  std::vector<std::size_t> first_;  // of each cell's list in in_cells_
  std::vector<int> in_cells_;
};

// From a point to the nearest point of a triangle.
double distance_to_triangle(const Eigen::Vector3d& x, const TriangleGrid::Triangle& triangle);

}  // namespace edgescout
