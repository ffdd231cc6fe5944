#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_control_flow_attributes : require
#include "information_push.h"
#include "information_read.glsl"

layout(local_size_x = INFORMATION_GROUP) in;
layout(binding = 3) writeonly buffer Shifts { float shifts[]; };

shared float parts[INFORMATION_GROUP];

void main() {
  const uint i = gl_WorkGroupID.x + gl_WorkGroupID.y * gl_NumWorkGroups.x, lane = gl_LocalInvocationID.x;
  if (i >= push.particles) return;
  float top = -3e38;
  [[dont_unroll]] for (uint j = lane; j < push.combinations; j += INFORMATION_GROUP) top = max(top, log_likelihood(i, j));
  parts[lane] = top;
  barrier();
  [[dont_unroll]] for (uint k = 0u; k < INFORMATION_GROUP; ++k) top = max(top, parts[k]);
  barrier();
  float sum = 0.0;
  [[dont_unroll]] for (uint j = lane; j < push.combinations; j += INFORMATION_GROUP) sum += exp(log_likelihood(i, j) - top);
  parts[lane] = sum;
  barrier();
  if (lane != 0u) return;
  sum = 0.0;
  [[dont_unroll]] for (uint k = 0u; k < INFORMATION_GROUP; ++k) sum += parts[k];
  shifts[i] = top + log(sum);
}
