// Directions from which an object may be seen, and how symmetry thins them out.
#pragma once

#include <vector>

#include "host/core/types.h"

namespace edgescout {

// Vertices of an icosahedron whose edges are cut into `frequency` parts and pushed onto the unit
// sphere: 10 * frequency^2 + 2 directions. No direction of the sphere is further than
// ICOSPHERE_GAP_RAD / frequency from one of them. LogicError: a frequency outside [1, 64].
inline constexpr double ICOSPHERE_GAP_RAD = 0.77;
std::vector<Eigen::Vector3d> icosphere(int frequency);

// Keeps those with latitude (angle to the object's x-y plane, + towards +z) and longitude (about z,
// from +x) in the given ranges, degrees. A longitude range may wrap (from 300 to 60).
struct SphereRange {
  double latitude_min_deg = -90, latitude_max_deg = 90;
  double longitude_min_deg = 0, longitude_max_deg = 360;
  bool contains(const Eigen::Vector3d& direction) const;
};

// Drops directions that a symmetry maps onto others: keeps the fundamental domain {d : d.w >= (S
// d).w for all S} for a generic w, widened by `margin_rad`. Where every direction of the sphere had
// one of the given within the margin, it has a kept one within it, modulo symmetry.
std::vector<Eigen::Vector3d> modulo_symmetry(const std::vector<Eigen::Vector3d>& directions,
                                             const Symmetries& symmetries, double margin_rad);

// The icosphere's directions that `range` asks for, modulo symmetry: those that a symmetry brings
// into the range are asked for too, one of each kind is kept.
std::vector<Eigen::Vector3d> viewpoints_in(const SphereRange& range, const Symmetries& symmetries,
                                           int frequency);

// Rotation camera_from_object of a camera at `direction` from the object that looks back at it; the
// roll about the line of sight is arbitrary but fixed.
Eigen::Quaterniond looking_from(const Eigen::Vector3d& direction);

}  // namespace edgescout
