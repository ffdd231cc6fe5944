// Which of many poses are one and the same object.
#pragma once

#include <array>
#include <span>
#include <vector>

#include "host/core/types.h"

namespace edgescout {

// Largest distance, m, between corresponding points of the object's bounding box under two poses:
// min over symmetries of the max over the eight corners. A cheap upper bound on MSSD that is zero
// only for equal poses (modulo symmetry).
double pose_distance_m(const Se3& a, const Se3& b, const Mesh& mesh, const Symmetries& symmetries);

// Greedy: goes through the poses in the given order and keeps those further than `radius_m` from
// all kept ones. Returns the kept indices, at most `most`.
std::vector<std::size_t> suppress_duplicates(std::span<const Se3> poses_best_first,
                                             const Mesh& mesh, const Symmetries& symmetries,
                                             double radius_m, std::size_t most);

// The same of poses in any order: the lower its key, the better a pose; ties in the order given.
// Indices best first.
std::vector<std::size_t> best_distinct(std::span<const Se3> poses, std::span<const double> keys,
                                       const Mesh& mesh, const Symmetries& symmetries,
                                       double radius_m, std::size_t most);

// Poses of one object where something is known to be.
class KnownPoses {
 public:
  KnownPoses(std::span<const Se3> poses, const Mesh& mesh, const Symmetries& symmetries);
  // Whether one of them lies within `radius_m` (pose_distance_m).
  bool any_within(double radius_m, const Se3& pose) const;

 private:
  std::vector<Se3> poses_;  // each in all its symmetric forms
  std::array<Eigen::Vector3d, 8> corners_;
  Eigen::Vector3d center_m_;
};

}  // namespace edgescout
