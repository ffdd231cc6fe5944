// The distance between two poses of an object, by the corners of its bounding box.
#pragma once

#include <array>
#include <span>
#include <vector>

#include "host/core/types.h"

namespace edgescout {

// The corners of the object's bounding box, in its frame.
std::array<Eigen::Vector3d, 8> box_corners(const Mesh& mesh);

// Largest distance, m, between corresponding corners of the object's bounding box under two poses:
// the minimum over symmetries of the maximum over the eight corners. A cheap upper bound on MSSD.
// It is zero only for equal poses, modulo symmetry.
double pose_distance_m(const Se3& a, const Se3& b, const Mesh& mesh, const Symmetries& symmetries);

// Known poses of one object, in any one frame.
class KnownPoses {
 public:
  KnownPoses(std::span<const Se3> poses, const Mesh& mesh, const Symmetries& symmetries);
  void add(const Se3& pose);
  // Whether a known pose lies within `radius_m` (pose_distance_m) of this one.
  bool any_within(double radius_m, const Se3& pose) const;

 private:
  std::vector<Se3> poses_, symmetries_;
  std::vector<Eigen::Vector3d> centers_m_;  // of the poses
  std::array<Eigen::Vector3d, 8> corners_;
  Eigen::Vector3d center_m_;
  double center_motion_m_ = 0;  // how far a symmetry moves the centre at most
};

}  // namespace edgescout
