#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_control_flow_attributes : require
#include "pose_normal_equations.h"
#include "pose_depth_push.h"

layout(local_size_x = POSE_GROUP) in;
layout(push_constant) uniform Push { PoseDepthPush push; };
layout(binding = 0) readonly buffer Points { float points[]; };
layout(binding = 1) readonly buffer Problems { uint problems[]; };
layout(binding = 2) writeonly buffer Results { float results[]; };
layout(binding = 3) readonly buffer Depth { float depth_m[]; };

// One column a sum, one row an invocation; the odd stride keeps both passes free of bank conflicts.
const uint STRIDE = POSE_GROUP + 1u;
shared float sums[POSE_DEPTH_SUMS * STRIDE];

#include "pose_problem.glsl"

// Places in the list of sums.
const uint GRADIENT = 21, COST = 27, WEIGHT = 28, OFFSET = 29, AGREEING = 30, CONTRADICTING = 31, HIDDEN = 32, MISSING = 33;

// What was measured in the pixel nearest to the point's image. Depth 0: nothing.
struct Measured {
  float depth;
  vec3 ray;
};

Measured measured_at(vec3 point) {
  const vec2 focal = vec2(push.camera.fx, push.camera.fy), centre = vec2(push.camera.cx, push.camera.cy);
  const vec2 at = focal * point.xy / point.z + centre + 0.5, size = vec2(push.width, push.height);
  if (!(at.x >= 0.0 && at.x < size.x && at.y >= 0.0 && at.y < size.y)) return Measured(0.0, vec3(0.0));
  const uvec2 pixel = min(uvec2(at), uvec2(push.width, push.height) - 1u);
  const float depth = depth_m[pixel.y * push.width + pixel.x];
  return Measured(depth > 0.0 && depth < float(POSE_MAX_RANGE_M) ? depth : 0.0, vec3((vec2(pixel) - centre) / focal, 1.0));
}

void main() {
  const uint lane = gl_LocalInvocationID.x, part = gl_WorkGroupID.x;
  const uint problem = push.first_problem + gl_WorkGroupID.y;
  const mat3 rotation = rotation_of(problem);
  const vec3 translation_m = translation_of(problem);
  const bool somewhere = is_somewhere(problem);
  const uint first = problems[problem * POSE_PROBLEM_WORDS + 12], count = problems[problem * POSE_PROBLEM_WORDS + 13];

  float total[POSE_DEPTH_SUMS];
  [[unroll]] for (uint s = 0; s < POSE_DEPTH_SUMS; ++s) total[s] = 0.0;
  [[dont_unroll]] for (uint i = part * POSE_GROUP + lane; somewhere && i < count; i += push.parts * POSE_GROUP) {
    const uint at = (first + i) * POSE_POINT_WORDS;
    const vec3 point = rotation * vec3(points[at], points[at + 1], points[at + 2]) + translation_m;
    const vec3 normal = rotation * vec3(points[at + 3], points[at + 4], points[at + 5]);
    if (!can_be_seen(point, push.camera) || !(dot(normal, point) <= -push.min_facing * length(point))) continue;
    const Measured measured = measured_at(point);
    const float d = measured.depth, slope = dot(normal, measured.ray);
    if (d == 0.0 || slope >= 0.0) {
      total[MISSING] += 1.0;
      continue;
    }
    const vec3 q = d * measured.ray;
    const float along = dot(normal, q - point), offset = along / slope;
    const float sigma = max(push.noise_floor_m, push.noise_per_m * d * d);
    const float band = max(push.band_m, push.band_sigmas * sigma);
    if (offset < -band) {
      total[HIDDEN] += 1.0;
      continue;
    }
    const float spread = sigma * slope, inverse = inversesqrt(spread * spread + push.surface_m * push.surface_m);
    const float r = along * inverse, scaled = r / push.loss_scale;
    const float share = 1.0 / (1.0 + scaled * scaled), weight = share * share;
    const vec3 by_translation = -inverse * normal, by_rotation = cross(q - translation_m, by_translation);
    const float[6] jacobian = float[6](by_translation.x, by_translation.y, by_translation.z, by_rotation.x,
                                       by_rotation.y, by_rotation.z);
    // Bounds and places known at compile time: or some drivers leave the loops, and the sums in
    // memory.
    [[unroll]] for (uint a = 0; a < 6; ++a) {
      const float weighted = weight * jacobian[a];
      [[unroll]] for (uint b = 0; b < 6; ++b)
        if (b >= a) total[a * (11u - a) / 2u + b] += weighted * jacobian[b];
      total[GRADIENT + a] += weighted * r;
    }
    total[COST] += 0.5 * share * r * r;
    total[WEIGHT] += weight;
    total[OFFSET] += weight * offset;
    total[AGREEING] += offset > band ? 0.0 : 1.0;
    total[CONTRADICTING] += offset > band ? 1.0 : 0.0;
  }
  [[unroll]] for (uint s = 0; s < POSE_DEPTH_SUMS; ++s) sums[s * STRIDE + lane] = total[s];
  barrier();
  if (lane < POSE_DEPTH_SUMS) {
    float sum = 0.0;
    [[dont_unroll]] for (uint i = 0; i < POSE_GROUP; ++i) sum += sums[lane * STRIDE + i];
    results[(problem * push.parts + part) * POSE_DEPTH_SUMS + lane] = sum;
  }
}
