#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_control_flow_attributes : require
#extension GL_KHR_memory_scope_semantics : require
#include "edge_link.h"
#include "edge_stages.h"
#include "angle.glsl"

layout(constant_id = 0) const uint PASS = EDGE_LINK_MERGE;
layout(local_size_x = EDGE_GROUP) in;
layout(push_constant) uniform Push { EdgeLinkPush push; };
layout(binding = 0) readonly buffer Gradient { uint gradient[]; };
layout(binding = 1) buffer Labels { uint labels[]; };
layout(binding = 2) buffer Components { uint components[]; };
layout(binding = 3) buffer Kept { uint kept[]; };
layout(binding = 4) writeonly buffer Points { vec4 points[]; };
#include "edge_read.glsl"

// For all passes that write labels: others may shrink the label meanwhile, and a plain read beside
// an atomic write is a race.
uint label_of(uint i) {
  return atomicLoad(labels[i], gl_ScopeDevice, gl_StorageSemanticsNone, gl_SemanticsRelaxed);
}

// Labels only ever shrink towards the root, so that a stale read costs a step and no correctness.
// Every step shortens the way for the next: where all pixels of an edge link at once, it would be
// as long as the edge.
uint root_of(uint i) {
  uint label = label_of(i);
  [[dont_unroll]] while (label != i) {
    const uint next = label_of(label);
    if (next != label) atomicMin(labels[i], next);
    i = label;
    label = next;
  }
  return i;
}

void join(uint a, uint b) {
  a = root_of(a);
  b = root_of(b);
  [[dont_unroll]] while (a != b) {
    if (a < b) {
      const uint swap = a;
      a = b;
      b = swap;
    }
    const uint before = atomicMin(labels[a], b);
    if (before == a) return;
    // `a` had been joined elsewhere meanwhile: that side has to meet b too.
    a = root_of(before);
    b = root_of(b);
  }
}

void merge(ivec2 p, uint i) {
  const ivec2 earlier[4] = ivec2[4](ivec2(-1, 0), ivec2(-1, -1), ivec2(0, -1), ivec2(1, -1));
  [[unroll]] for (uint n = 0; n < 4; ++n) {
    // No candidate lies on the outermost ring: the neighbours exist.
    const uint q = uint(p.y + earlier[n].y) * push.width + uint(p.x + earlier[n].x);
    if (label_of(q) != EDGE_NO_LABEL) join(i, q);
  }
}

void count(ivec2 p, uint i) {
  const uint root = root_of(i);
  atomicAdd(components[root], 1u);
  if (squared_at(p) >= push.high2) atomicOr(components[root], EDGE_STRONG);
}

void keep(uint i) {
  const uint component = components[root_of(i)];
  if ((component & EDGE_STRONG) == 0u || (component & ~EDGE_STRONG) < push.min_length_px) return;
  kept[1u + atomicAdd(kept[0], 1u)] = i;
}

// Logarithm of the magnitude across the edge on one side, against the one here.
float log_ratio(ivec2 p, Across a, int side, float here) {
  const float near = sqrt(float(squared_at(p + side * a.axis))), diagonal = sqrt(float(squared_at(p + side * a.turn)));
  const float r = float(a.smaller) / float(a.larger);
  return log(max(1.0, (1.0 - r) * near + r * diagonal) / here);
}

// How far along the step across the edge the profile has its top.
float offset_across(ivec2 p, Across a, float here) {
  const float before = log_ratio(p, a, -1, here), after = log_ratio(p, a, 1, here);
  return clamp(0.5 * (before - after) / min(before + after, -1.0 / 256.0), -0.5, 0.5);
}

float falloff(float span, float reach) {
  const float rest = max(0.0, 1.0 - span * span / (reach * reach));
  return rest * rest;
}

// The line fitted to the gradient's turn along the edge, read off at the pixel itself.
float turn_along(ivec2 p, vec2 n) {
  const int reach = int(EDGE_WINDOW);
  const ivec2 low = max(p - reach, ivec2(0)), high = min(p + reach, ivec2(push.width, push.height) - 1);
  float w = 0.0, wu = 0.0, wuu = 0.0, wa = 0.0, wua = 0.0;
  [[dont_unroll]] for (int y = low.y; y <= high.y; ++y)
    [[dont_unroll]] for (int x = low.x; x <= high.x; ++x) {
      if (labels[uint(y) * push.width + uint(x)] == EDGE_NO_LABEL) continue;
      const vec2 g = vec2(gradient_at(ivec2(x, y))), d = vec2(ivec2(x, y) - p);
      const float size = length(g), agreement = dot(n, g) / size;
      if (agreement <= 0.0) continue;
      const float u = d.y * n.x - d.x * n.y, sine = (n.x * g.y - n.y * g.x) / size;
      const float turn = sine * (1.0 + sine * sine / 6.0);
      const float a2 = agreement * agreement, a4 = a2 * a2;
      const float weight = falloff(u, EDGE_REACH_ALONG) * falloff(dot(d, n), EDGE_REACH_ACROSS) * a4 * a4 * dot(g, g);
      w += weight;
      wu += weight * u;
      wuu += weight * u * u;
      wa += weight * turn;
      wua += weight * u * turn;
    }
  // Means instead of sums: products of sums of squared gradients would leave float's range.
  const float mu = wu / w, ma = wa / w;
  const float slope = (wua / w - mu * ma) / (wuu / w - mu * mu + 0.5);
  return ma - slope * mu;
}

vec4 edge_point(uint i) {
  const ivec2 p = ivec2(int(i % push.width), int(i / push.width)), g = gradient_at(p);
  const Across a = across_edge(g);
  const float size = sqrt(float(squared_at(p))), t = offset_across(p, a, size);
  const float minor = t * float(a.smaller) / float(a.larger);
  const vec2 step = a.axis.x != 0 ? vec2(t, minor) : vec2(minor, t);
  float theta = undirected_angle(vec2(g)) + 0.5 * PI + turn_along(p, vec2(g) / size);
  theta -= PI * floor(theta / PI);  // a device's quotient may be off by a little, to either side
  const bool is_turn = theta >= 0.0 && theta < PI;
  return vec4(vec2(p) + vec2(a.turn) * step, is_turn ? theta : 0.0, size / float(EDGE_GRADIENT_SCALE));
}

void main() {
  const uint i = gl_GlobalInvocationID.x + gl_GlobalInvocationID.y * gl_NumWorkGroups.x * EDGE_GROUP;
  if (i >= push.count) return;
  if (PASS == EDGE_LINK_POINT) {
    points[i] = edge_point(kept[1u + i]);
    return;
  }
  if (label_of(i) == EDGE_NO_LABEL) return;
  const ivec2 p = ivec2(int(i % push.width), int(i / push.width));
  if (PASS == EDGE_LINK_MERGE)
    merge(p, i);
  else if (PASS == EDGE_LINK_COUNT)
    count(p, i);
  else
    keep(i);
}
