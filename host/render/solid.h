// Closed solids by extrusion and revolution, made of triangles that share every corner.
//
// Lengths here are millimetres, as on a drawing; `finish` converts.
#pragma once

#include <string>
#include <vector>

#include "host/core/types.h"
#include "host/render/triangulate.h"

namespace edgescout {

// A round hole straight through two parallel sides of an extrusion. Side i runs from corner i to
// corner i + 1 of the outline.
struct CrossHole {
  int from_side = 0;
  int to_side = 0;
  double along_mm = 0;   // of the axis, from corner from_side
  double height_mm = 0;  // of the axis, over the bottom
  double radius_mm = 0;
};

struct Extrusion {
  Loop2d outline_mm;                   // counter-clockwise
  std::vector<Loop2d> holes_mm;        // clockwise; right through, along z
  std::vector<CrossHole> cross_holes;  // must not meet each other nor the holes
  double height_mm = 0;                // z from 0 to here
};

// Circle for a hole (clockwise) or an outline (counter-clockwise).
Loop2d circle(const Eigen::Vector2d& centre_mm, double radius_mm, bool clockwise, int corners = 32);

// Object frame: centre of the bounding box.
Mesh extrude(const std::string& name, const Extrusion& extrusion);
// `profile_mm` is a closed counter-clockwise loop of (r, z), r >= 0, turned about z. Corners with r
// = 0 lie on the axis.
Mesh revolve(const std::string& name, const Loop2d& profile_mm, int segments = 48);

// Volume enclosed by a closed mesh, m^3; positive where its triangles face outwards.
double enclosed_volume_m3(const Mesh& mesh);

}  // namespace edgescout
