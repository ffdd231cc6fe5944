// The exact diameter of a point set.
#pragma once

#include <vector>

#include <Eigen/Core>

namespace edgescout {

// The largest distance between two of the points; 0 for fewer than two. Exact: pairs of grid cells
// whose boxes cannot hold a longer pair than the best known are skipped, all others are compared
// point by point.
double largest_distance(const std::vector<Eigen::Vector3d>& points);

}  // namespace edgescout
