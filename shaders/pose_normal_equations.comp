#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_control_flow_attributes : require
#include "pose_normal_equations.h"
#include "pose_push.h"
#include "tensor_read.glsl"
#include "pose_point.glsl"

layout(local_size_x = POSE_GROUP) in;
layout(push_constant) uniform Push { PoseSystemPush push; };
layout(binding = 4) readonly buffer Points { float points[]; };
layout(binding = 5) readonly buffer Problems { uint problems[]; };
layout(binding = 6) writeonly buffer Results { float results[]; };

// One column a sum, one row an invocation; the odd stride keeps both passes free of bank conflicts.
const uint STRIDE = POSE_GROUP + 1u;
shared float sums[POSE_SYSTEM_SUMS * STRIDE];

#include "pose_problem.glsl"

// Derivative of the value by the pose: through the projection and through the orientation.
float[6] jacobian_of(PosedPoint p, ProjectedEdge edge, vec3 slope) {
  const float z = p.point.z, norm2 = dot(edge.direction, edge.direction);
  const float least = push.min_foreshortening * push.camera.fx * z;
  const float turn = norm2 > least * least ? slope.z / norm2 : 0.0;
  const vec2 along = turn * vec2(-edge.direction.y * push.camera.fx, edge.direction.x * push.camera.fy);
  const vec2 by_pixel = slope.xy * vec2(push.camera.fx, push.camera.fy) / z;
  const vec3 by_point =
      vec3(by_pixel - along * p.tangent.z, -dot(by_pixel, p.point.xy) / z + dot(along, p.tangent.xy));
  const vec3 by_tangent = vec3(along * z, -dot(along, p.point.xy));
  const vec3 by_rotation = cross(p.arm, by_point) + cross(p.tangent, by_tangent);
  return float[6](by_point.x, by_point.y, by_point.z, by_rotation.x, by_rotation.y, by_rotation.z);
}

// Cost and weight of a residual.
vec2 apply_loss(float r) {
  const float s = push.scale_px;
  if (push.loss == LOSS_HUBER) return r <= s ? vec2(0.5 * r * r, 1.0) : vec2(s * (r - 0.5 * s), s / r);
  const float q = s * s / (s * s + r * r);
  return vec2(0.5 * q * r * r, q * q);
}

void main() {
  const uint lane = gl_LocalInvocationID.x, part = gl_WorkGroupID.x;
  const uint problem = push.first_problem + gl_WorkGroupID.y;
  const mat3 rotation = rotation_of(problem);
  const vec3 translation_m = translation_of(problem);
  const bool somewhere = is_somewhere(problem);
  const uint first = problems[problem * POSE_PROBLEM_WORDS + 12], count = problems[problem * POSE_PROBLEM_WORDS + 13];

  float total[POSE_SYSTEM_SUMS];
  [[unroll]] for (uint s = 0; s < POSE_SYSTEM_SUMS; ++s) total[s] = 0.0;
  [[dont_unroll]] for (uint i = part * POSE_GROUP + lane; i < count; i += push.parts * POSE_GROUP) {
    const uint at = (first + i) * POSE_POINT_WORDS;
    const PosedPoint p = pose_point(rotation, translation_m, vec3(points[at], points[at + 1], points[at + 2]),
                                    vec3(points[at + 3], points[at + 4], points[at + 5]));
    if (!somewhere || !can_be_seen(p.point, push.camera)) {
      total[31] += 1.0;
      continue;
    }
    const ProjectedEdge edge = project_edge(p, push.camera);
    const Lookup read = tensor_lookup(push.grid, edge.at, undirected_angle(edge.direction));
    const float[6] jacobian = jacobian_of(p, edge, read.slope);
    const vec2 cost_weight = apply_loss(read.value);
    // Bounds and places known at compile time: or some drivers leave the loops, and the sums in
    // memory.
    [[unroll]] for (uint a = 0; a < 6; ++a) {
      const float weighted = cost_weight.y * jacobian[a];
      [[unroll]] for (uint b = 0; b < 6; ++b)
        if (b >= a) total[a * (11u - a) / 2u + b] += weighted * jacobian[b];
      total[21 + a] += weighted * read.value;
    }
    total[27] += cost_weight.x;
    total[28] += read.value;
    total[29] += cost_weight.y;
    total[30] += 1.0;
  }
  [[unroll]] for (uint s = 0; s < POSE_SYSTEM_SUMS; ++s) sums[s * STRIDE + lane] = total[s];
  barrier();
  if (lane < POSE_SYSTEM_SUMS) {
    float sum = 0.0;
    [[dont_unroll]] for (uint i = 0; i < POSE_GROUP; ++i) sum += sums[lane * STRIDE + i];
    results[(problem * push.parts + part) * POSE_SYSTEM_SUMS + lane] = sum;
  }
}
