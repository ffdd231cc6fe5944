#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_control_flow_attributes : require
#include "dcd_sweep.h"

layout(constant_id = 0) const uint RADIUS = 3;
layout(local_size_x = DCD_SWEEP_GROUP) in;
layout(push_constant) uniform Push { DcdSweepPush push; };
layout(binding = 0) buffer Tensor { uvec2 tensor[]; };
layout(binding = 1) readonly buffer Weights { uint weights[]; };

// Newest first. As long as any radius asks for: a length that is specialized is not understood by
// every driver. Loops over it count up from 0: some drivers do not unroll others, and leave the
// window in memory.
uvec4 window[2 * DCD_SWEEP_MAX_RADIUS + 1];
uint base;

// The low pixels of both words, then the high ones.
uvec4 unpack(uvec2 w) { return uvec4(w & 0xffffu, w >> 16); }
uvec2 pack(uvec4 v) { return v.xy | (v.zw << 16); }
uint line_of(uint bin) { return base + bin * DCD_SWEEP_LANES; }
uvec4 advance(uvec4 carry, uint bin) { return min(carry + push.step, unpack(tensor[line_of(bin)])); }

void forward() {
  uvec4 carry = uvec4(push.cap);
  [[dont_unroll]] for (uint k = push.bins - push.reach; k < push.bins; ++k) carry = advance(carry, k);
  [[dont_unroll]] for (uint k = 0; k < push.bins; ++k) {
    carry = advance(carry, k);
    tensor[line_of(k)] = pack(carry);
  }
}

void push_value(uvec4 value) {
  [[unroll]] for (uint i = 0; i < 2 * RADIUS; ++i) window[2 * RADIUS - i] = window[2 * RADIUS - 1 - i];
  window[0] = value;
}

void write_smoothed(uint bin) {
  uvec4 sum = window[RADIUS] * weights[0] + (1u << 14);
  [[unroll]] for (uint d = 1; d <= RADIUS; ++d) sum += weights[d] * (window[RADIUS - d] + window[RADIUS + d]);
  sum >>= 15;
  tensor[line_of(bin)] = pack(sum);
}

// Downwards from bin RADIUS - 1 of the next turn, so that the window is full when the highest bin
// is written. The first RADIUS values of this turn are needed once more at its end, when their
// places have been overwritten.
void backward() {
  uvec4 carry = uvec4(push.cap);
  [[dont_unroll]] for (uint s = push.reach; s > 0; --s) carry = advance(carry, (RADIUS + s - 1) % push.bins);
  [[unroll]] for (uint i = 0; i < RADIUS; ++i) push_value(carry = advance(carry, RADIUS - 1 - i));
  uvec4 highest[DCD_SWEEP_MAX_RADIUS];
  [[unroll]] for (uint i = 0; i < RADIUS; ++i) push_value(highest[i] = carry = advance(carry, push.bins - 1 - i));
  [[dont_unroll]] for (uint k = push.bins - RADIUS; k > 0; --k) {
    push_value(carry = advance(carry, k - 1));
    write_smoothed(k - 1 + RADIUS);
  }
  [[unroll]] for (uint i = 0; i < RADIUS; ++i) {
    push_value(highest[i]);
    write_smoothed(RADIUS - 1 - i);
  }
}

void main() {
  const uint i = gl_GlobalInvocationID.x + gl_GlobalInvocationID.y * gl_NumWorkGroups.x * DCD_SWEEP_GROUP;
  const uint tile = i / DCD_SWEEP_LANES;
  if (tile >= push.tile_count) return;
  base = tile * push.bins * DCD_SWEEP_LANES + i % DCD_SWEEP_LANES;
  forward();
  backward();
}
