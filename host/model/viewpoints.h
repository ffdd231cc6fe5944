// Viewing directions around an object, with and without those that symmetry makes redundant.
//
// Public header.
#pragma once

#include <vector>

#include "host/core/types.h"

namespace edgescout {

// Vertices of an icosahedron whose edges are divided into `frequency` parts, projected onto the
// unit sphere: 10 * frequency^2 + 2 directions. No direction of the sphere is further than
// ICOSPHERE_GAP_RAD / frequency from one of them. LogicError: a frequency outside [1, 64].
inline constexpr double ICOSPHERE_GAP_RAD = 0.77;
std::vector<Eigen::Vector3d> icosphere(int frequency);

// Ranges of latitude (angle to the object's x-y plane, + towards +z) and longitude (about z, from
// +x), degrees. A longitude range may wrap (from 300 to 60).
struct SphereRange {
  double latitude_min_deg = -90, latitude_max_deg = 90;
  double longitude_min_deg = 0, longitude_max_deg = 360;
  bool contains(const Eigen::Vector3d& direction) const;
};

// Returns the directions without those that a symmetry maps onto others: it keeps the fundamental
// domain {d : d.w >= (S d).w for all S} for a generic w, widened by `margin_rad`. If every
// direction of the sphere had a given one within the margin, it has a kept one within the margin,
// modulo symmetry.
std::vector<Eigen::Vector3d> modulo_symmetry(const std::vector<Eigen::Vector3d>& directions,
                                             const Symmetries& symmetries, double margin_rad);

// Returns the icosphere's directions in `range`, modulo symmetry. Directions that a symmetry maps
// into the range count as inside; of equivalent directions one is kept.
std::vector<Eigen::Vector3d> viewpoints_in(const SphereRange& range, const Symmetries& symmetries,
                                           int frequency);

// Returns the rotation camera_from_object of a camera that lies at `direction` from the object and
// looks at it. The roll about the line of sight is arbitrary but fixed.
Eigen::Quaterniond looking_from(const Eigen::Vector3d& direction);

}  // namespace edgescout
