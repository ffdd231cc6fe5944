// Which poses of an object are distinct: the distance between two poses, by the corners of the
// object's bounding box, and what follows from it. Poses that lie near each other are one and the
// same object.
#pragma once

#include <array>
#include <span>
#include <vector>

#include "host/core/types.h"

namespace edgescout {

class ThreadPool;

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

// Indices of distinct poses, at most `most`. Goes through the poses in the given order and keeps
// those further than `radius_m` from all kept ones.
std::vector<std::size_t> suppress_duplicates(std::span<const Se3> poses_best_first,
                                             const Mesh& mesh, const Symmetries& symmetries,
                                             double radius_m, std::size_t most);

// The same for poses in any order, with one key per pose: a lower key is better. Indices of the
// best pose first; ties in the order given.
std::vector<std::size_t> best_distinct(std::span<const Se3> poses, std::span<const double> keys,
                                       const Mesh& mesh, const Symmetries& symmetries,
                                       double radius_m, std::size_t most);

struct DistinctInView {
  double fraction;   // of the object's diameter
  std::size_t most;  // that are kept
};

// As best_distinct, for poses in the frame of the camera that searches them. Their distance counts
// by the size that it gives the object alone: both poses are scaled about the camera until their
// centres are 1 m away. Kept is what then lies further than the fraction of the object's diameter,
// scaled as the pose is, from all kept ones. Every centre lies before the camera. The number of
// threads changes nothing.
std::vector<std::size_t> best_distinct_in_view(std::span<const Se3> camera_from_object,
                                               std::span<const double> keys, const Mesh& mesh,
                                               const Symmetries& symmetries,
                                               const DistinctInView& limits, ThreadPool& threads);

}  // namespace edgescout
