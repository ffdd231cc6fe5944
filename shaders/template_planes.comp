#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_control_flow_attributes : require
#include "template_score.h"
#include "template_scan.h"
#include "tensor_read.glsl"

layout(local_size_x = TEMPLATE_PLANES_GROUP) in;
layout(push_constant) uniform Push { TemplatePlanesPush push; };
layout(binding = 4) writeonly buffer Planes { uint planes[]; };

uint value_at(int x, int y, uint bin) {
  // Negative coordinates are large ones.
  if (bin >= push.tensor.bins || uint(x) >= push.tensor.width || uint(y) >= push.tensor.height)
    return TEMPLATE_SCORE_OUTSIDE;
  const uint v16 = tensor_at(push.tensor, uint(x), uint(y), bin);
  return min(TEMPLATE_SCORE_CAP, (v16 + (1u << (TEMPLATE_SCORE_SHIFT - 1u))) >> TEMPLATE_SCORE_SHIFT);
}

// One word of all four copies: seven values.
void main() {
  uint i = gl_GlobalInvocationID.x + gl_GlobalInvocationID.y * gl_NumWorkGroups.x * TEMPLATE_PLANES_GROUP;
  if (i >= push.word_count) return;
  const TemplatePlanesGrid grid = push.planes;
  const uint at = i;
  const uint word = i % grid.stride;
  i /= grid.stride;
  const uint remainder = i % grid.anchor_step;
  i /= grid.anchor_step;
  const int y = int(i % grid.rows) - int(grid.top);
  const uint bin = i / grid.rows;
  const int x = int(4u * word * grid.anchor_step + remainder) - int(grid.left);
  uint values[7];
  [[unroll]] for (uint k = 0u; k < 7u; ++k) values[k] = value_at(x + int(k * grid.anchor_step), y, bin);
  [[unroll]] for (uint copy = 0u; copy < 4u; ++copy)
    planes[copy * push.word_count + at] = values[copy] | values[copy + 1u] << 8 |
                                          values[copy + 2u] << 16 | values[copy + 3u] << 24;
}
