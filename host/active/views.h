// The places a camera may be sent to: generated on a hemisphere or read from a file.
#pragma once

#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "host/core/se3.h"

namespace edgescout {

// camera_from_world of a camera at `eye_m` that looks at `target_m`, the world's +z up in its
// image; looking straight up or down, +y up. InputError where the two points are one.
Se3 look_at(const Eigen::Vector3d& eye_m, const Eigen::Vector3d& target_m);

// Rings of cameras over the world's plane z = center.z, all looking at the centre.
struct HemisphereOptions {
  Eigen::Vector3d center_m = Eigen::Vector3d::Zero();
  double radius_m = 0.5;
  std::vector<double> elevations_deg{35, 55, 75};  // above the plane, each in (0, 90]
  int count = 32;  // of cameras, shared among the rings by their circumference; at least one a ring
  void validate() const;  // InputError naming the field and the violated bound
};

// camera_from_world of each, ring by ring in the given order; neighbouring rings are turned against
// each other.
std::vector<Se3> hemisphere_views(const HemisphereOptions& options);

// The point nearest to all optical axes: what the cameras look at. World frame. Nothing where they
// look at no point in common: a single one, axes parallel to some 3 degrees, or for half of the
// cameras or more a point that is not before them (a head that only pans and tilts).
std::optional<Eigen::Vector3d> looked_at_m(std::span<const Se3> camera_from_world);

// Unit vectors from there to each camera, in the world's frame.
std::vector<Eigen::Vector3d> directions_to(std::span<const Se3> camera_from_world,
                                           const Eigen::Vector3d& center_m);
// Where above is for cameras in these directions: the mean one, unit. Nothing where they stand all
// around.
std::optional<Eigen::Vector3d> direction_above(std::span<const Eigen::Vector3d> directions);

// At least one view, each finite and rigid, no two alike (closer than 0.1 mm and 0.1 mrad).
// InputError naming `source` and the view.
void validate_views(std::span<const Se3> camera_from_world, const std::string& source);

// A view list is JSON: [{"camera_from_world": {"R": 9 numbers by row, "t": 3 in metres}}, ...].
// Written atomically; reading throws InputError naming file and field and validates.
void save_views(std::span<const Se3> camera_from_world, const std::filesystem::path& file);
std::vector<Se3> load_views(const std::filesystem::path& file);

}  // namespace edgescout
