#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_control_flow_attributes : require
#include "information_push.h"
#include "information_read.glsl"

layout(local_size_x = INFORMATION_GROUP) in;
layout(binding = 3) readonly buffer Shifts { float shifts[]; };
layout(binding = 4) writeonly buffer Shares { float shares[]; };

void main() {
  const uint j = (gl_WorkGroupID.x + gl_WorkGroupID.y * gl_NumWorkGroups.x) * INFORMATION_GROUP + gl_LocalInvocationID.x;
  if (j >= push.combinations) return;
  float evidence = 0.0;
  [[dont_unroll]] for (uint i = 0u; i < push.particles; ++i) evidence += weight_of(i) * exp(log_likelihood(i, j) - shifts[i]);
  float share = 0.0;
  if (evidence > 0.0) {
    const float log_evidence = log(evidence);
    [[dont_unroll]] for (uint i = 0u; i < push.particles; ++i) {
      const float log_l = log_likelihood(i, j) - shifts[i], l = exp(log_l);
      share += weight_of(i) * max(0.0, l * (log_l - log_evidence) - l + evidence);
    }
  }
  shares[j] = share;
}
