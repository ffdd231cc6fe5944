// Makes closed solids by extrusion and revolution, of triangles that share every corner.
//
// Lengths are in millimetres, as on a drawing. The returned meshes are in metres.
#pragma once

#include <string>
#include <vector>

#include "host/core/types.h"
#include "host/render/triangulate.h"

namespace edgescout {

// A straight round hole through two parallel sides of an extrusion. Side i goes from corner i to
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
  std::vector<Loop2d> holes_mm;        // clockwise; through the whole solid, along z
  std::vector<CrossHole> cross_holes;  // must not meet each other or the holes
  double height_mm = 0;                // z from 0 to here
};

// Returns a circle for a hole (clockwise) or an outline (counter-clockwise).
Loop2d circle(const Eigen::Vector2d& centre_mm, double radius_mm, bool clockwise, int corners = 32);

// The origin of the object frame is the centre of the bounding box.
Mesh extrude(const std::string& name, const Extrusion& extrusion);
// Turns `profile_mm` about z: a closed counter-clockwise loop of (r, z), r >= 0. Corners with r = 0
// lie on the axis.
Mesh revolve(const std::string& name, const Loop2d& profile_mm, int segments = 48);

// Returns the volume of a closed mesh, m^3; positive if its triangles face outwards.
double enclosed_volume_m3(const Mesh& mesh);

}  // namespace edgescout
