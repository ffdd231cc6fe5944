#version 460
#extension GL_GOOGLE_include_directive : require
#include "point_visibility.h"
#include "finite.glsl"

layout(local_size_x = POINT_VISIBILITY_GROUP) in;
layout(push_constant) uniform Push { PointVisibilityPush push; };
layout(binding = 0) readonly buffer Depth { float depth[]; };
layout(binding = 1) readonly buffer Points { float points[]; };
layout(binding = 2) readonly buffer Jobs { uint jobs[]; };
layout(binding = 3) writeonly buffer Flags { uint flags[]; };

shared uint bits[POINT_VISIBILITY_WORDS];

float number_at(uint at) { return uintBitsToFloat(jobs[at]); }

vec3 in_camera(uint job_at, uint point) {
  const vec3 p = vec3(points[3u * point], points[3u * point + 1u], points[3u * point + 2u]);
  vec3 moved;
  for (uint i = 0u; i < 3u; ++i)
    moved[i] = number_at(job_at + 4u * i) * p.x + number_at(job_at + 4u * i + 1u) * p.y +
               number_at(job_at + 4u * i + 2u) * p.z + number_at(job_at + 4u * i + 3u);
  return moved;
}

// x: visible, y: borders the background.
bvec2 flags_of(uint job, vec3 p) {
  const uint at = job * VISIBILITY_JOB_WORDS + 12u;
  const vec2 focal = vec2(number_at(at), number_at(at + 1u)),
             centre = vec2(number_at(at + 2u), number_at(at + 3u));
  const vec2 pixel = focal * p.xy / p.z + centre + 0.5;
  const float last = float(push.size) - 1.0;
  if (!finite(pixel.x) || !finite(pixel.y) ||
      !(pixel.x >= 1.0 && pixel.y >= 1.0 && pixel.x < last && pixel.y < last))
    return bvec2(true);
  const float nearest_m = p.z - number_at(at + 4u);
  const uint middle = (job * push.size + uint(pixel.y)) * push.size + uint(pixel.x);
  bool is_visible = false, is_border = false;
  for (int y = -1; y <= 1; ++y)
    for (int x = -1; x <= 1; ++x) {
      const float seen_m = depth[uint(int(middle) + y * int(push.size) + x)];
      const bool is_empty = !finite(seen_m);
      is_border = is_border || is_empty;
      is_visible = is_visible || is_empty || seen_m >= nearest_m;
    }
  return bvec2(is_visible, is_border);
}

void main() {
  const uint job = gl_WorkGroupID.y + gl_WorkGroupID.z * gl_NumWorkGroups.y;
  if (job >= push.jobs) return;
  const uint lane = gl_LocalInvocationID.x, group = gl_WorkGroupID.x;
  const uint job_at = job * VISIBILITY_JOB_WORDS;
  const uint first = jobs[job_at + 17u], own = jobs[job_at + 18u], first_word = jobs[job_at + 19u];
  const uint i = group * POINT_VISIBILITY_GROUP + lane, count = push.shared_points + own;
  if (lane < POINT_VISIBILITY_WORDS) bits[lane] = 0u;
  barrier();
  if (i < count) {
    const vec3 p = in_camera(job_at, i < push.shared_points ? i : first + i - push.shared_points);
    if (!is_nan(p.z) && p.z > 0.0) {
      const bvec2 found = flags_of(job, p);
      if (found.x) atomicOr(bits[lane / 32u], 1u << (lane % 32u));
      if (found.y) atomicOr(bits[2u + lane / 32u], 1u << (lane % 32u));
    }
  }
  barrier();
  if (lane < POINT_VISIBILITY_WORDS && group * POINT_VISIBILITY_GROUP < count)
    flags[first_word + POINT_VISIBILITY_WORDS * group + lane] = bits[lane];
}
