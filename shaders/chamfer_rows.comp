#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_control_flow_attributes : require
#include "chamfer_push.h"
#include "chamfer_read.glsl"

layout(local_size_x = CHAMFER_GROUP) in;
layout(push_constant) uniform Push { ChamferPush push; };
layout(binding = 0) readonly buffer Rows { uint rows[]; };
layout(binding = 1) readonly buffer Reach { uint reach[]; };
layout(binding = 2) readonly buffer Bits { uint bits[]; };
layout(binding = 3) writeonly buffer Bytes { uint bytes[]; };

void main() {
  const uint i = (gl_WorkGroupID.x + gl_WorkGroupID.y * gl_NumWorkGroups.x) * CHAMFER_GROUP + gl_LocalInvocationID.x;
  const uint r = i / push.words, word = i % push.words;
  if (r >= push.count) return;
  const uint at = r * CHAMFER_ROW_WORDS, first = rows[at], end = first + rows[at + 1u];
  // Hidden combinations are never taken and keep 0.
  uint remaining = bits[rows[at + 2u] * push.words + word];
  uint quads[CHAMFER_QUADS];
  for (uint q = 0u; q < CHAMFER_QUADS; ++q) quads[q] = 0u;
  [[dont_unroll]] for (uint e = first; e < end && remaining != 0u; ++e) {
    const uint distance = reach[e] >> 24, take = remaining & bits[(reach[e] & 0xffffffu) * push.words + word];
    [[unroll]] for (uint q = 0u; q < CHAMFER_QUADS; ++q) quads[q] |= distance * bytes_of(bitfieldExtract(take, int(4u * q), 4));
    remaining &= ~take;
  }
  for (uint q = 0u; q < CHAMFER_QUADS; ++q)
    bytes[i * CHAMFER_QUADS + q] = quads[q] | push.cap * bytes_of(bitfieldExtract(remaining, int(4u * q), 4));
}
