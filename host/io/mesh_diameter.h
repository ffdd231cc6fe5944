// Computes the exact diameter of a point set.
#pragma once

#include <vector>

#include <Eigen/Core>

namespace edgescout {

// Returns the largest distance between two of the points; 0 for fewer than two. A pair of grid
// cells is skipped if their boxes cannot hold a pair longer than the best known one. All other
// pairs of cells are compared point by point, so the result is exact.
double largest_distance(const std::vector<Eigen::Vector3d>& points);

}  // namespace edgescout
