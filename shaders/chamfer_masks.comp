#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_control_flow_attributes : require
#include "chamfer_push.h"

layout(local_size_x = CHAMFER_GROUP) in;
layout(push_constant) uniform Push { ChamferPush push; };
layout(binding = 0) readonly buffer Masks { uint masks[]; };
layout(binding = 1) readonly buffer Hiders { uint hiders[]; };
layout(binding = 2) readonly buffer Columns { uint columns[]; };
layout(binding = 3) writeonly buffer Bits { uint bits[]; };

uint column(uint candidate, uint word) { return columns[candidate * push.column_words + push.first_word + word]; }

void main() {
  const uint i = (gl_WorkGroupID.x + gl_WorkGroupID.y * gl_NumWorkGroups.x) * CHAMFER_GROUP + gl_LocalInvocationID.x;
  const uint m = i / push.words, word = i % push.words;
  if (m >= push.count) return;
  const uint at = m * CHAMFER_MASK_WORDS, member = masks[at], first = masks[at + 1u], count = masks[at + 2u];
  uint mask = member == CHAMFER_NO_MEMBER ? 0xffffffffu : column(member, word);
  [[dont_unroll]] for (uint h = 0u; h < count; ++h) mask &= ~column(hiders[first + h], word);
  bits[i] = mask;
}
