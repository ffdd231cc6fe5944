#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_control_flow_attributes : require
#include "pose_normal_equations.h"
#include "pose_push.h"
#include "tensor_read.glsl"
#include "pose_point.glsl"

layout(local_size_x = POSE_GROUP) in;
layout(push_constant) uniform Push { PoseScorePush push; };
layout(binding = 4) readonly buffer Points { float points[]; };
layout(binding = 5) readonly buffer Problems { uint problems[]; };
layout(binding = 6) writeonly buffer Results { float results[]; };
layout(binding = 7) readonly buffer Gradient { uint gradient_x2[]; };

const uint STRIDE = POSE_GROUP + 1u;
shared float sums[POSE_SCORE_SUMS * STRIDE];

#include "pose_problem.glsl"

// |n . g| / |g| of Eq. 10, n the normal of the projected edge; 0 where the gradient is too weak to
// have a direction.
float direction_agreement(ProjectedEdge edge) {
  const uvec2 pixel = uvec2(clamp(ivec2(floor(edge.at + 0.5)), ivec2(0), ivec2(push.grid.width, push.grid.height) - 1));
  const int packed = int(gradient_x2[pixel.y * push.grid.width + pixel.x]);
  const vec2 g = vec2(bitfieldExtract(packed, 0, 16), bitfieldExtract(packed, 16, 16));
  const float strength2 = dot(g, g), length2 = dot(edge.direction, edge.direction);
  if (strength2 < 4.0 * push.min_gradient * push.min_gradient || strength2 == 0.0 || length2 == 0.0) return 0.0;
  return abs(edge.direction.x * g.y - edge.direction.y * g.x) / sqrt(strength2 * length2);
}

bool in_image(vec2 at) {
  return at.x >= -0.5 && at.x < float(push.grid.width) - 0.5 && at.y >= -0.5 && at.y < float(push.grid.height) - 0.5;
}

void main() {
  const uint lane = gl_LocalInvocationID.x, part = gl_WorkGroupID.x;
  const uint problem = push.first_problem + gl_WorkGroupID.y;
  const mat3 rotation = rotation_of(problem);
  const vec3 translation_m = translation_of(problem);
  const bool somewhere = is_somewhere(problem);
  const uint first = problems[problem * POSE_PROBLEM_WORDS + 12], count = problems[problem * POSE_PROBLEM_WORDS + 13];

  vec4 total = vec4(0.0);  // values, direction agreements, matched, points
  [[dont_unroll]] for (uint i = part * POSE_GROUP + lane; i < count; i += push.parts * POSE_GROUP) {
    const uint at = (first + i) * POSE_POINT_WORDS;
    const PosedPoint p = pose_point(rotation, translation_m, vec3(points[at], points[at + 1], points[at + 2]),
                                    vec3(points[at + 3], points[at + 4], points[at + 5]));
    if (!somewhere || !can_be_seen(p.point, push.camera)) continue;
    const ProjectedEdge edge = project_edge(p, push.camera);
    if (!in_image(edge.at)) continue;
    const float value = tensor_lookup(push.grid, edge.at, undirected_angle(edge.direction)).value;
    total += vec4(value, push.has_gradient != 0u ? direction_agreement(edge) : 0.0, value < push.match_px ? 1.0 : 0.0, 1.0);
  }
  [[unroll]] for (uint s = 0; s < POSE_SCORE_SUMS; ++s) sums[s * STRIDE + lane] = total[s];
  barrier();
  if (lane < POSE_SCORE_SUMS) {
    float sum = 0.0;
    [[dont_unroll]] for (uint i = 0; i < POSE_GROUP; ++i) sum += sums[lane * STRIDE + i];
    results[(problem * push.parts + part) * POSE_SCORE_SUMS + lane] = sum;
  }
}
