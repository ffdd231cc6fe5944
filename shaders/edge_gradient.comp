#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_control_flow_attributes : require
#include "edge_gradient.h"
#include "edge_stages.h"

layout(constant_id = 0) const uint PASS = EDGE_ROWS;
layout(local_size_x = EDGE_GROUP) in;
layout(push_constant) uniform Push { EdgeGradientPush push; };
layout(binding = 0) readonly buffer Image { uint image[]; };
layout(binding = 1) readonly buffer Weights { int weights[]; };
layout(binding = 2) buffer Rows { uint rows[]; };
layout(binding = 3) writeonly buffer Gradient { uint gradient[]; };

const uint DERIVATIVE = EDGE_MAX_RADIUS + 1u;

int pixel_at(int x, int y) {
  const uint i = uint(y) * push.width + uint(clamp(x, 0, int(push.width) - 1));
  return int(bitfieldExtract(image[i >> 2], int(8u * (i & 3u)), 8));
}

// Smoothed and differentiated along the row.
ivec2 row_at(int x, int y) {
  const int pair = int(rows[uint(clamp(y, 0, int(push.height) - 1)) * push.width + uint(x)]);
  return ivec2(bitfieldExtract(pair, 0, 16), bitfieldExtract(pair, 16, 16));
}

uint pack(int low, int high) { return (uint(low) & 0xffffu) | (uint(high) << 16); }

uint along_row(int x, int y) {
  int smoothed = weights[0] * pixel_at(x, y), slope = 0;
  [[dont_unroll]] for (uint i = 1; i <= push.radius; ++i) {
    const int before = pixel_at(x - int(i), y), after = pixel_at(x + int(i), y);
    smoothed += weights[i] * (before + after);
    slope += weights[DERIVATIVE + i] * (after - before);
  }
  return pack((smoothed + 64) >> 7, (slope + 64) >> 7);
}

uint along_column(int x, int y) {
  int gx = weights[0] * row_at(x, y).y, gy = 0;
  [[dont_unroll]] for (uint i = 1; i <= push.radius; ++i) {
    const ivec2 before = row_at(x, y - int(i)), after = row_at(x, y + int(i));
    gx += weights[i] * (before.y + after.y);
    gy += weights[DERIVATIVE + i] * (after.x - before.x);
  }
  return pack((gx + 8192) >> 14, (gy + 8192) >> 14);
}

void main() {
  const uint x = gl_GlobalInvocationID.x, y = gl_GlobalInvocationID.y;
  if (x >= push.width) return;
  if (PASS == EDGE_ROWS)
    rows[y * push.width + x] = along_row(int(x), int(y));
  else
    gradient[y * push.width + x] = along_column(int(x), int(y));
}
