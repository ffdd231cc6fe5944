// Leaves out duplicates: poses that are one and the same object, by their distance
// (pose_distance.h).
#pragma once

#include <span>
#include <vector>

#include "host/core/types.h"

namespace edgescout {

class ThreadPool;

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
