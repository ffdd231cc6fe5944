#version 460
#extension GL_GOOGLE_include_directive : require
#include "edge_thin.h"

layout(local_size_x = EDGE_GROUP) in;
layout(push_constant) uniform Push { EdgeThinPush push; };
layout(binding = 0) readonly buffer Gradient { uint gradient[]; };
layout(binding = 1) writeonly buffer Labels { uint labels[]; };
#include "edge_read.glsl"

uint ring(ivec2 p, Across a, uint f, int k) {
  return (256u - f) * (squared_at(p + k * a.axis) >> 6) + f * (squared_at(p + k * a.turn) >> 6);
}

bool is_candidate(ivec2 p) {
  if (p.x < 1 || p.y < 1 || p.x + 1 >= int(push.width) || p.y + 1 >= int(push.height)) return false;
  const uint here = squared_at(p);
  if (here < push.low2) return false;
  const Across a = across_edge(gradient_at(p));
  const uint f = (256u * a.smaller + a.larger / 2u) / a.larger, centre = 256u * (here >> 6);
  return centre > ring(p, a, f, -1) && centre >= ring(p, a, f, 1);
}

void main() {
  const uvec2 p = gl_GlobalInvocationID.xy;
  if (p.x >= push.width) return;
  const uint i = p.y * push.width + p.x;
  labels[i] = is_candidate(ivec2(p)) ? i : EDGE_NO_LABEL;
}
