#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_control_flow_attributes : require
#include "edge_thin.h"
#include "support_map.h"
#include "support_map_push.h"

layout(constant_id = 0) const uint PASS = SUPPORT_DIRECTIONS;
layout(local_size_x = SUPPORT_MAP_GROUP) in;
layout(push_constant) uniform Push { SupportMapPush push; };
layout(binding = 0) readonly buffer Gradient { uint gradient[]; };
layout(binding = 1) readonly buffer Labels { uint labels[]; };
layout(binding = 2) readonly buffer Tables { int tables[]; };
layout(binding = 3) buffer Directions { uint directions[]; };
layout(binding = 4) writeonly buffer Map { uint map[]; };

const uint REACH = 4u * SUPPORT_BINS;  // of the tables' words

uint directions_of(ivec2 g) {
  uint bits = 0u;
  [[dont_unroll]] for (uint b = 0u; b < SUPPORT_BINS; ++b) {
    const int low = tables[4u * b] * g.y - tables[4u * b + 1u] * g.x;
    const int high = g.x * tables[4u * b + 3u] - g.y * tables[4u * b + 2u];
    if ((low >= 0 && high >= 0) || (low <= 0 && high <= 0)) bits |= 1u << b;
  }
  return bits;
}

uint spread_to(ivec2 p) {
  const int window = int(SUPPORT_WINDOW);
  uint bits = 0u;
  [[dont_unroll]] for (int dy = -window; dy <= window; ++dy)
    [[dont_unroll]] for (int dx = -window; dx <= window; ++dx) {
      const ivec2 q = p + ivec2(dx, dy);
      if (q.x < 0 || q.y < 0 || q.x >= int(push.width) || q.y >= int(push.height)) continue;
      const uint reach = uint(tables[REACH + uint((dy + window) * (2 * window + 1) + dx + window)]);
      bits |= directions[uint(q.y) * push.width + uint(q.x)] & reach;
    }
  return bits;
}

void main() {
  const uvec2 p = gl_GlobalInvocationID.xy;
  if (p.x >= push.width) return;
  const uint i = p.y * push.width + p.x;
  if (PASS == SUPPORT_SPREAD) {
    map[i] = spread_to(ivec2(p));
    return;
  }
  const int pair = int(gradient[i]);
  const ivec2 g = ivec2(bitfieldExtract(pair, 0, 16), bitfieldExtract(pair, 16, 16));
  directions[i] = labels[i] == EDGE_NO_LABEL ? 0u : directions_of(g);
}
