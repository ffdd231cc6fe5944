// The project's own parts: small textureless CAD models, made by code, free to ship.
#pragma once

#include <map>
#include <span>
#include <string>
#include <vector>

#include "host/core/types.h"

namespace edgescout {

// "l_bracket", "bearing_block", "stepped_shaft", "hex_nut", "u_channel", "gear_plate", in this
// order of BOP ids 1, 2 ..
std::vector<std::string> part_names();

// Closed, triangles outwards, 30 to 80 mm, origin in the middle of the bounding box; symmetries
// filled (that of the turned part in 64 steps). InputError naming the known parts on another name.
Object make_part(const std::string& name);
// Of the given parts, those that look the same at every turn: BOP id and the axis, through the
// origin.
std::map<int, Eigen::Vector3d> turning_axes(std::span<const Object> parts);

// Nameless things to lie about: a box of the given sides, a round bar, a ring.
Mesh make_box(const Eigen::Vector3d& size_m);
Mesh make_bar(double radius_m, double length_m);
Mesh make_ring(double outer_radius_m, double inner_radius_m, double height_m);

}  // namespace edgescout
