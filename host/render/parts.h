// Makes the project's own parts: small textureless CAD models, made by code and free to distribute.
#pragma once

#include <map>
#include <span>
#include <string>
#include <vector>

#include "host/core/types.h"

namespace edgescout {

// "l_bracket", "bearing_block", "stepped_shaft", "hex_nut", "u_channel", "gear_plate". Their BOP
// ids are 1, 2 .. in this order.
std::vector<std::string> part_names();

// Makes a closed part of 30 to 80 mm with outward triangles and its origin in the middle of its
// bounding box. Symmetries are filled in (64 steps for the turned part). InputError naming the
// known parts: another name.
Object make_part(const std::string& name);
// Returns the surfaces of revolution among the given parts: BOP id and axis, through the origin.
std::map<int, Eigen::Vector3d> turning_axes(std::span<const Object> parts);

// Foreign objects for clutter: a box of the given sides, a round bar, a ring.
Mesh make_box(const Eigen::Vector3d& size_m);
Mesh make_bar(double radius_m, double length_m);
Mesh make_ring(double outer_radius_m, double inner_radius_m, double height_m);

}  // namespace edgescout
