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

// Of 16 combinations: component k of `of[c]` is that of 4k + c.
struct Totals {
  uvec4 of[4];
};

Totals no_totals() { return Totals(uvec4[4](uvec4(0u), uvec4(0u), uvec4(0u), uvec4(0u))); }

// Of pairs in 16 bits: 4k and 4k + 2, 4k + 1 and 4k + 3.
void add_pairs(inout Totals totals, uvec4 even, uvec4 odd) {
  totals.of[0] += even & 0xffffu;
  totals.of[1] += odd & 0xffffu;
  totals.of[2] += even >> 16;
  totals.of[3] += odd >> 16;
}

void add_bytes(inout Totals totals, uvec4 four) {
  [[unroll]] for (uint c = 0u; c < 4u; ++c) totals.of[c] += four >> (8u * c) & 0xffu;
}

Totals sum_distances(uint first, uint end, uint half_word) {
  const uint stride = push.words * CHAMFER_HALVES;
  Totals total = no_totals();
  uvec4 even = uvec4(0u), odd = uvec4(0u);
  uint points = 0u;
  [[dont_unroll]] for (uint v = first; v < end; ++v) {
    const uvec2 visit = visits[v];
    const uint count = visit.y & 0xffffu;
    if (points + count > CHAMFER_POINTS_AT_ONCE) {
      add_pairs(total, even, odd);
      even = uvec4(0u);
      odd = uvec4(0u);
      points = 0u;
    }
    points += count;
    const uvec4 row = bytes[visit.x * stride + half_word];
    even += (row & 0x00ff00ffu) * count;
    odd += (row >> 8 & 0x00ff00ffu) * count;
  }
  add_pairs(total, even, odd);
  return total;
}

void count_hidden(uint first, uint end, uint half_word, out Totals hidden, out Totals hidden_unseen) {
  hidden = no_totals();
  hidden_unseen = no_totals();
  uvec4 all = uvec4(0u), unseen = uvec4(0u);
  uint points = 0u;
  [[dont_unroll]] for (uint v = first; v < end; ++v) {
    const uvec2 visit = visits[v];
    const uint count = visit.y & 0xffffu;
    if (points + count > CHAMFER_POINTS_AT_ONCE) {
      add_bytes(hidden, all);
      add_bytes(hidden_unseen, unseen);
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
  add_bytes(hidden, all);
  add_bytes(hidden_unseen, unseen);
}

void main() {
  const uint halves = push.words * CHAMFER_HALVES, groups = (halves + CHAMFER_GROUP - 1u) / CHAMFER_GROUP;
  const uint group = gl_WorkGroupID.x + gl_WorkGroupID.y * gl_NumWorkGroups.x;
  const uint i = group / groups, half_word = group % groups * CHAMFER_GROUP + gl_LocalInvocationID.x;
  if (i >= push.count || half_word >= halves) return;
  const uint first_j = push.first_word * 32u + half_word * 16u;
  if (first_j >= push.combinations) return;
  const uint cell = i * push.combinations + first_j, cells = min(16u, push.combinations - first_j);
  const uint at = i * CHAMFER_RUN_WORDS, end = particles[at + 2u];
  // Distances are written before the rest is counted: fewer sums are held at a time.
  const Totals distances = sum_distances(particles[at], end, half_word);
  [[unroll]] for (uint k = 0u; k < 16u; ++k)
    if (k < cells) sums[cell + k] = distances.of[k % 4u][k / 4u];
  Totals hidden, hidden_unseen;
  count_hidden(particles[at + 1u], end, half_word, hidden, hidden_unseen);
  const uint points = particles[at + 3u], unseen = particles[at + 4u];
  [[unroll]] for (uint k = 0u; k < 16u; ++k)
    if (k < cells)
      counts[cell + k] = (unseen - hidden_unseen.of[k % 4u][k / 4u]) << 16 | (points - hidden.of[k % 4u][k / 4u]);
}
