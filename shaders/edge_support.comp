#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_control_flow_attributes : require
#include "edge_support_push.h"

layout(local_size_x = EDGE_SUPPORT_GROUP) in;
layout(push_constant) uniform Push { EdgeSupportPush push; };
layout(binding = 0) readonly buffer Map { uint map[]; };
layout(binding = 1) readonly buffer Points { uint points[]; };
layout(binding = 2) readonly buffer Problems { uint problems[]; };
layout(binding = 3) readonly buffer Tables { int tables[]; };
layout(binding = 4) writeonly buffer Sums { uint sums[]; };

const uint LOG_RATIOS = 2u * SUPPORT_COPIES;  // of the tables' words
const uint SUPPORTED = SUPPORT_PARTS;         // of the sums' words
const uint WEIGHT = SUPPORTED + SUPPORT_COPIES + 1u;

shared uint group_sums[SUPPORT_SUM_WORDS];  // those of ratios are signed, in two's complement

uint support_at(ivec2 p, uint bin) {
  if (p.x < 0 || p.y < 0 || p.x >= int(push.width) || p.y >= int(push.height)) return 0u;
  return map[uint(p.y) * push.width + uint(p.x)] >> bin & 1u;
}

// Adds one point to the group's sums.
void add_point(uint at) {
  const uint place = points[at], rest = points[at + 1u];
  const ivec2 p = ivec2(place & 0xffffu, place >> 16);
  const uint weight = rest & 0xffffu, bin = rest >> 16 & 0xffu, part = rest >> 24;
  const uint supported = support_at(p, bin);
  uint chance = 0u;
  [[dont_unroll]] for (uint k = 0u; k < SUPPORT_COPIES; ++k) {
    const uint of_copy = support_at(p + ivec2(tables[2u * k], tables[2u * k + 1u]), bin);
    chance += of_copy;
    if (of_copy != 0u) atomicAdd(group_sums[SUPPORTED + 1u + k], weight);
  }
  if (supported != 0u) atomicAdd(group_sums[SUPPORTED], weight);
  atomicAdd(group_sums[WEIGHT], weight);
  const uint interior = part < SUPPORT_SECTORS ? 0u : 1u;
  const int log_ratio = tables[LOG_RATIOS + (2u * interior + supported) * (SUPPORT_COPIES + 1u) + chance];
  atomicAdd(group_sums[part], uint(int(weight) * log_ratio));
}

void main() {
  const uint lane = gl_LocalInvocationID.x, index = gl_WorkGroupID.x + gl_WorkGroupID.y * gl_NumWorkGroups.x;
  if (lane < SUPPORT_SUM_WORDS) group_sums[lane] = 0u;
  barrier();
  const uint problem = push.first_problem + index;
  if (index < push.problem_count) {
    const uint first = problems[problem * SUPPORT_PROBLEM_WORDS], count = problems[problem * SUPPORT_PROBLEM_WORDS + 1u];
    [[dont_unroll]] for (uint i = lane; i < count; i += EDGE_SUPPORT_GROUP)
      add_point((first + i) * SUPPORT_POINT_WORDS);
  }
  barrier();
  if (index < push.problem_count && lane < SUPPORT_SUM_WORDS)
    sums[problem * SUPPORT_SUM_WORDS + lane] = group_sums[lane];
}
