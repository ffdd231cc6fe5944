// What kernels exchange: plain 32-bit structs, the same bytes on the CPU and on the device.
//
// Public header.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

namespace edgescout {

// A grey image somebody else owns; row-major, no padding.
struct ImageView {
  int width = 0;
  int height = 0;
  const std::uint8_t* pixels = nullptr;
};

// One edgel. Edges are undirected: theta is the direction *along* the edge, in [0, pi), measured
// from +x towards +y (image axes: y points down).
struct EdgePoint {
  float x_px = 0;
  float y_px = 0;
  float theta_rad = 0;
  float strength = 0;  // gradient magnitude, grey levels a pixel
};

// One raster point of a model's edge, in the object frame: position and unit tangent of its 3-D
// edge. It carries what the paper's pair (o, o') carries (Eq. 1), in the limit dr -> 0.
struct ModelPoint {
  float x_m, y_m, z_m;
  float tx, ty, tz;
};

// Ideal pinhole; pixel centres at integers.
struct Intrinsics {
  float fx, fy, cx, cy;
};

// Rigid transform, row-major [R | t], metres.
struct Pose {
  float m[12];
};

}  // namespace edgescout
