// Triangulates a planar polygon with holes by ear clipping.
#pragma once

#include <array>
#include <vector>

#include <Eigen/Core>

namespace edgescout {

// A closed loop of corners; the last is joined to the first. Two neighbouring edges must not be
// parallel at their corner.
using Loop2d = std::vector<Eigen::Vector2d>;

// `outline` is counter-clockwise. `holes` are clockwise, disjoint and inside it. Returns
// counter-clockwise triangles of indices into outline, hole 0, hole 1 .. one after the other.
// LogicError: the loops are not such a polygon.
std::vector<std::array<int, 3>> triangulate(const Loop2d& outline,
                                            const std::vector<Loop2d>& holes);

double signed_area(const Loop2d& loop);  // positive: counter-clockwise

}  // namespace edgescout
