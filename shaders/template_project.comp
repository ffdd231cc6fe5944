#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_control_flow_attributes : require
#include "template_project.h"
#include "template_point.glsl"

layout(local_size_x = TEMPLATE_PROJECT_GROUP) in;
layout(push_constant) uniform Push { TemplateProjectPush push; };
layout(binding = 0) readonly buffer Planes { float planes[]; };
layout(binding = 1) readonly buffer Jobs { uint jobs[]; };
layout(binding = 2) writeonly buffer Projected { uvec2 projected[]; };
layout(binding = 3) writeonly buffer TooNear { uint too_near[]; };

shared uint near_count;

struct Job {
  mat3 rotation;
  vec3 translation_m;
  uint first_point;
  uint point_count;
  uint first_projected;
  vec2 anchor;
};

Job read_job(uint j) {
  const uint at = j * TEMPLATE_PROJECT_JOB_WORDS;
  float m[12];
  [[unroll]] for (uint i = 0; i < 12u; ++i) m[i] = uintBitsToFloat(jobs[at + i]);
  return Job(mat3(m[0], m[4], m[8], m[1], m[5], m[9], m[2], m[6], m[10]), vec3(m[3], m[7], m[11]),
             jobs[at + 12], jobs[at + 13], jobs[at + 14],
             vec2(uintBitsToFloat(jobs[at + 15]), uintBitsToFloat(jobs[at + 16])));
}

// Three of the planes, from `first` on.
vec3 read_planes(uint first, uint point) {
  const uint at = first * push.point_count + point;
  return vec3(planes[at], planes[at + push.point_count], planes[at + 2u * push.point_count]);
}

// A TemplatePoint: dx and dy in the halves of the first word, the bin in the second.
uvec2 pack(ivec2 offset, uint bin) {
  return uvec2((uint(offset.x) & 0xffffu) | (uint(offset.y) << 16), bin);
}

void main() {
  const uint j = gl_WorkGroupID.x + gl_WorkGroupID.y * gl_NumWorkGroups.x;
  if (j >= push.job_count) return;
  const uint lane = gl_LocalInvocationID.x;
  if (lane == 0u) near_count = 0u;
  barrier();
  const Job job = read_job(j);
  const vec2 focal = vec2(push.fx, push.fy), centre = vec2(push.cx, push.cy);
  uint nearer = 0;
  [[dont_unroll]] for (uint i = lane; i < job.point_count; i += TEMPLATE_PROJECT_GROUP) {
    const vec3 p = job.rotation * read_planes(0u, job.first_point + i) + job.translation_m;
    const vec3 q = job.rotation * read_planes(3u, job.first_point + i);
    const ImagePoint point = image_point(p, q, focal, centre, job.anchor, push.nearest_m, push.bins);
    if (point.is_near) ++nearer;
    projected[job.first_projected + i] = pack(point.offset, point.bin);
  }
  if (nearer > 0u) atomicAdd(near_count, nearer);
  barrier();
  if (lane == 0u) too_near[j] = near_count;
}
