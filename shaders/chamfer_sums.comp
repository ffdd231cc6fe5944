#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_control_flow_attributes : require
#include "chamfer_push.h"
#include "chamfer_read.glsl"

layout(local_size_x = CHAMFER_GROUP) in;
layout(push_constant) uniform Push { ChamferPush push; };
layout(binding = 0) readonly buffer Particles { uint particles[]; };
layout(binding = 1) readonly buffer Visits { uvec2 visits[]; };
layout(binding = 2) readonly buffer Rows { uint rows[]; };
layout(binding = 3) readonly buffer Bits { uint bits[]; };
layout(binding = 4) readonly buffer Bytes { uvec4 bytes[]; };
layout(binding = 5) writeonly buffer Sums { uint sums[]; };
layout(binding = 6) writeonly buffer Counts { uint counts[]; };

// Of 16 combinations; those of one component of `even` and `odd` are 4k, 4k + 2 and 4k + 1, 4k + 3.
uint distance_sum[16];
uint hidden_sum[16];
uint hidden_unseen_sum[16];

void flush_pairs(uvec4 even, uvec4 odd) {
  for (uint k = 0u; k < 4u; ++k) {
    distance_sum[4u * k] += even[k] & 0xffffu;
    distance_sum[4u * k + 1u] += odd[k] & 0xffffu;
    distance_sum[4u * k + 2u] += even[k] >> 16;
    distance_sum[4u * k + 3u] += odd[k] >> 16;
  }
}

void flush_bytes(uvec4 all, uvec4 unseen) {
  for (uint k = 0u; k < 16u; ++k) {
    hidden_sum[k] += all[k / 4u] >> (8u * (k % 4u)) & 0xffu;
    hidden_unseen_sum[k] += unseen[k / 4u] >> (8u * (k % 4u)) & 0xffu;
  }
}

void sum_distances(uint first, uint end, uint half_word) {
  const uint stride = push.words * CHAMFER_HALVES;
  uvec4 even = uvec4(0u), odd = uvec4(0u);
  uint points = 0u;
  [[dont_unroll]] for (uint v = first; v < end; ++v) {
    const uvec2 visit = visits[v];
    const uint count = visit.y & 0xffffu;
    if (points + count > CHAMFER_POINTS_AT_ONCE) {
      flush_pairs(even, odd);
      even = uvec4(0u);
      odd = uvec4(0u);
      points = 0u;
    }
    points += count;
    const uvec4 row = bytes[visit.x * stride + half_word];
    even += (row & 0x00ff00ffu) * count;
    odd += (row >> 8 & 0x00ff00ffu) * count;
  }
  flush_pairs(even, odd);
}

void count_hidden(uint first, uint end, uint half_word) {
  uvec4 all = uvec4(0u), unseen = uvec4(0u);
  uint points = 0u;
  [[dont_unroll]] for (uint v = first; v < end; ++v) {
    const uvec2 visit = visits[v];
    const uint count = visit.y & 0xffffu;
    if (points + count > CHAMFER_POINTS_AT_ONCE) {
      flush_bytes(all, unseen);
      all = uvec4(0u);
      unseen = uvec4(0u);
      points = 0u;
    }
    points += count;
    const uint word = ~bits[rows[visit.x * CHAMFER_ROW_WORDS + 2u] * push.words + half_word / CHAMFER_HALVES];
    const uint gone = word >> (16u * (half_word % CHAMFER_HALVES));
    const uvec4 four = uvec4(bytes_of(gone & 0xfu), bytes_of(gone >> 4 & 0xfu), bytes_of(gone >> 8 & 0xfu), bytes_of(gone >> 12 & 0xfu));
    all += four * count;
    unseen += four * (visit.y >> 16);
  }
  flush_bytes(all, unseen);
}

void main() {
  const uint halves = push.words * CHAMFER_HALVES, groups = (halves + CHAMFER_GROUP - 1u) / CHAMFER_GROUP;
  const uint group = gl_WorkGroupID.x + gl_WorkGroupID.y * gl_NumWorkGroups.x;
  const uint i = group / groups, half_word = group % groups * CHAMFER_GROUP + gl_LocalInvocationID.x;
  if (i >= push.count || half_word >= halves) return;
  for (uint k = 0u; k < 16u; ++k) {
    distance_sum[k] = 0u;
    hidden_sum[k] = 0u;
    hidden_unseen_sum[k] = 0u;
  }
  const uint at = i * CHAMFER_RUN_WORDS, end = particles[at + 2u];
  sum_distances(particles[at], end, half_word);
  count_hidden(particles[at + 1u], end, half_word);
  const uint points = particles[at + 3u], unseen = particles[at + 4u];
  for (uint k = 0u; k < 16u; ++k) {
    const uint j = push.first_word * 32u + half_word * 16u + k;
    if (j >= push.combinations) return;
    sums[i * push.combinations + j] = distance_sum[k];
    counts[i * push.combinations + j] = (unseen - hidden_unseen_sum[k]) << 16 | (points - hidden_sum[k]);
  }
}
