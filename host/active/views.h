// The poses that a camera may be sent to: generated on a hemisphere or read from a file.
//
// Public header.
#pragma once

#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "host/core/se3.h"

namespace edgescout {

// Returns camera_from_world of a camera at `eye_m` that looks at `target_m`. The world's +z is up
// in its image; for a camera that looks straight up or down, +y is up. InputError where the two
// points are the same.
Se3 look_at(const Eigen::Vector3d& eye_m, const Eigen::Vector3d& target_m);

// Rings of cameras above the world's plane z = center.z, all looking at the centre.
struct HemisphereOptions {
  Eigen::Vector3d center_m = Eigen::Vector3d::Zero();
  double radius_m = 0.5;
  std::vector<double> elevations_deg{35, 55, 75};  // above the plane, each in (0, 90]
  int count = 32;  // of cameras, shared among the rings by circumference; at least one per ring
  void validate() const;  // InputError naming the field and the violated bound
};

// Returns camera_from_world of each camera, ring by ring in the given order. Neighbouring rings are
// turned against each other.
std::vector<Se3> hemisphere_views(const HemisphereOptions& options);

// Returns the point that the cameras look at: nearest to all optical axes, world frame. Nothing
// where there is no common point: for a single camera, for axes parallel to some 3 degrees, or
// where the point lies in front of no more than half of the cameras (for example a head that only
// pans and tilts).
std::optional<Eigen::Vector3d> looked_at_m(std::span<const Se3> camera_from_world);

// Returns unit vectors from that point to each camera, world frame.
std::vector<Eigen::Vector3d> directions_to(std::span<const Se3> camera_from_world,
                                           const Eigen::Vector3d& center_m);
// Returns which way is up for cameras in these directions: the mean direction, unit. Nothing where
// the cameras stand all around.
std::optional<Eigen::Vector3d> direction_above(std::span<const Eigen::Vector3d> directions);

// Checks that there is at least one view, each finite and rigid, no two the same (nearer than
// 0.1 mm and 0.1 mrad). InputError naming `source` and the view.
void validate_views(std::span<const Se3> camera_from_world, const std::string& source);

// Writes or reads a list of views, which is JSON: [{"camera_from_world": {"R": 9 numbers by row,
// "t": 3 in metres}}, ...]. It is written atomically. Reading validates the views; InputError
// naming file and field.
void save_views(std::span<const Se3> camera_from_world, const std::filesystem::path& file);
std::vector<Se3> load_views(const std::filesystem::path& file);

}  // namespace edgescout
