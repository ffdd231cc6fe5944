// Triangles of a planar polygon with holes, by ear clipping.
#pragma once

#include <array>
#include <vector>

#include <Eigen/Core>

namespace edgescout {

// Closed loop of corners; the last is joined to the first. No two neighbouring edges may be
// parallel at a corner.
using Loop2d = std::vector<Eigen::Vector2d>;

// `outline` counter-clockwise, `holes` clockwise, disjoint and inside it. Indices into outline,
// hole 0, hole 1 .. one after the other; triangles counter-clockwise. LogicError where the loops
// are not such a polygon.
std::vector<std::array<int, 3>> triangulate(const Loop2d& outline,
                                            const std::vector<Loop2d>& holes);

double signed_area(const Loop2d& loop);  // positive: counter-clockwise

}  // namespace edgescout
