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
layout(binding = 3) writeonly buffer Bytes { uvec4 bytes[]; };

// Bytes of the 16 combinations of a half of a word: `value` where the bit is set.
uvec4 bytes_of_half(uint word, uint half_word, uint value) {
  const uint bits16 = word >> (16u * half_word);
  return value * uvec4(bytes_of(bits16 & 0xfu), bytes_of(bits16 >> 4 & 0xfu), bytes_of(bits16 >> 8 & 0xfu),
                       bytes_of(bits16 >> 12 & 0xfu));
}

void main() {
  const uint i = (gl_WorkGroupID.x + gl_WorkGroupID.y * gl_NumWorkGroups.x) * CHAMFER_GROUP + gl_LocalInvocationID.x;
  const uint r = i / push.words, word = i % push.words;
  if (r >= push.count) return;
  const uint at = r * CHAMFER_ROW_WORDS, first = rows[at], end = first + rows[at + 1u];
  // Hidden combinations are never taken and keep 0.
  uint remaining = bits[rows[at + 2u] * push.words + word];
  uvec4 low = uvec4(0u), high = uvec4(0u);
  [[dont_unroll]] for (uint e = first; e < end && remaining != 0u; ++e) {
    const uint distance = reach[e] >> 24, take = remaining & bits[(reach[e] & 0xffffffu) * push.words + word];
    low |= bytes_of_half(take, 0u, distance);
    high |= bytes_of_half(take, 1u, distance);
    remaining &= ~take;
  }
  bytes[i * CHAMFER_HALVES] = low | bytes_of_half(remaining, 0u, push.cap);
  bytes[i * CHAMFER_HALVES + 1u] = high | bytes_of_half(remaining, 1u, push.cap);
}
