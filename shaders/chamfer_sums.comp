#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_control_flow_attributes : require
#include "chamfer_push.h"
#include "chamfer_read.glsl"

layout(local_size_x = CHAMFER_GROUP) in;
layout(push_constant) uniform Push { ChamferPush push; };
layout(binding = 0) readonly buffer Particles { uint particles[]; };
layout(binding = 1) readonly buffer Points { uint points[]; };
layout(binding = 2) readonly buffer Rows { uint rows[]; };
layout(binding = 3) readonly buffer Bits { uint bits[]; };
layout(binding = 4) readonly buffer Bytes { uint bytes[]; };
layout(binding = 5) writeonly buffer Sums { uint sums[]; };
layout(binding = 6) writeonly buffer Counts { uint counts[]; };

uvec4 unpacked(uint four) { return uvec4(four, four >> 8, four >> 16, four >> 24) & 0xffu; }

uvec4 sum_distances(uint first, uint end, uint quad) {
  const uint stride = push.words * CHAMFER_QUADS;
  uvec4 sum = uvec4(0u);
  [[dont_unroll]] for (uint begin = first; begin < end; begin += CHAMFER_POINTS_AT_ONCE) {
    uint even = 0u, odd = 0u;
    const uint stop = min(end, begin + CHAMFER_POINTS_AT_ONCE);
    [[dont_unroll]] for (uint p = begin; p < stop; ++p) {
      const uint four = bytes[(points[p] >> 1) * stride + quad];
      even += four & 0x00ff00ffu;
      odd += (four >> 8) & 0x00ff00ffu;
    }
    sum += uvec4(even & 0xffffu, odd & 0xffffu, even >> 16, odd >> 16);
  }
  return sum;
}

void count_hidden(uint first, uint end, uint quad, out uvec4 hidden, out uvec4 fresh) {
  hidden = uvec4(0u);
  fresh = uvec4(0u);
  [[dont_unroll]] for (uint begin = first; begin < end; begin += CHAMFER_POINTS_AT_ONCE) {
    uint all = 0u, new = 0u;
    const uint stop = min(end, begin + CHAMFER_POINTS_AT_ONCE);
    [[dont_unroll]] for (uint p = begin; p < stop; ++p) {
      const uint visible = rows[(points[p] >> 1) * CHAMFER_ROW_WORDS + 2u];
      const uint word = ~bits[visible * push.words + quad / CHAMFER_QUADS];
      const uint gone = bytes_of(bitfieldExtract(word, int(4u * (quad % CHAMFER_QUADS)), 4));
      all += gone;
      new += gone * (points[p] & 1u);
    }
    hidden += unpacked(all);
    fresh += unpacked(new);
  }
}

void main() {
  const uint quads = push.words * CHAMFER_QUADS, groups = (quads + CHAMFER_GROUP - 1u) / CHAMFER_GROUP;
  const uint group = gl_WorkGroupID.x + gl_WorkGroupID.y * gl_NumWorkGroups.x;
  const uint i = group / groups, quad = group % groups * CHAMFER_GROUP + gl_LocalInvocationID.x;
  if (i >= push.count || quad >= quads) return;
  const uint at = i * CHAMFER_RUN_WORDS, first = particles[at], end = particles[at + 2u];
  uvec4 hidden, hidden_fresh;
  count_hidden(particles[at + 1u], end, quad, hidden, hidden_fresh);
  const uvec4 sum = sum_distances(first, end, quad), seen = end - first - hidden, fresh = particles[at + 3u] - hidden_fresh;
  for (uint k = 0u; k < 4u; ++k) {
    const uint j = push.first_word * 32u + quad * 4u + k;
    if (j >= push.realizations) return;
    sums[i * push.realizations + j] = sum[k];
    counts[i * push.realizations + j] = fresh[k] << 16 | seen[k];
  }
}
