#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_control_flow_attributes : require
#include "depth_raster_push.h"

layout(local_size_x = DEPTH_GROUP) in;
layout(push_constant) uniform Push { DepthRasterPush push; };
layout(binding = 0) readonly buffer Vertices { float vertices[]; };
layout(binding = 1) readonly buffer Triangles { uint triangles[]; };
layout(binding = 2) readonly buffer Jobs { float jobs[]; };
layout(binding = 3) buffer Depth { uint depth[]; };

struct Triangle {
  vec3 plane[3];  // of the edges, against corner 0, 1, 2; >= 0 inside
  vec3 z;         // of the corners
  ivec2 low;      // box of pixels, inclusive
  ivec2 size;     // empty where not positive
};

shared uint large_count;
shared Triangle large[DEPTH_GROUP];

// Products written out, for `precise` does not reach into the built-in ones: what two triangles
// share they must compute alike, to the last bit, or a pixel between them belongs to neither.
float dot_of(vec3 a, vec3 b) {
  precise const float sum = a.x * b.x + a.y * b.y + a.z * b.z;
  return sum;
}
vec3 cross_of(vec3 a, vec3 b) {
  precise const vec3 product = vec3(a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x);
  return product;
}

float coordinate(uint row, vec3 p) {
  precise const float value = dot_of(vec3(jobs[row], jobs[row + 1], jobs[row + 2]), p) + jobs[row + 3];
  return value;
}
vec3 corner(uint job, uint triangle, uint k) {
  const uint v = 3u * triangles[3u * triangle + k], row = job * DEPTH_JOB_WORDS;
  const vec3 p = vec3(vertices[v], vertices[v + 1], vertices[v + 2]);
  return vec3(coordinate(row, p), coordinate(row + 4u, p), coordinate(row + 8u, p));
}

// Zero on the plane through the camera and the edge a b, positive to the left of it. For both
// triangles at the edge from the end of the lower number on.
vec3 edge_plane(vec3 a, vec3 b, bool is_rising) {
  precise const vec3 from = is_rising ? a : b, along = is_rising ? b - a : a - b;
  const vec3 plane = cross_of(from, along);
  return is_rising ? plane : -plane;
}

vec2 focal_of(uint job) { return vec2(jobs[job * DEPTH_JOB_WORDS + 12], jobs[job * DEPTH_JOB_WORDS + 13]); }
vec2 centre_of(uint job) { return vec2(jobs[job * DEPTH_JOB_WORDS + 14], jobs[job * DEPTH_JOB_WORDS + 15]); }

Triangle set_up(uint job, uint triangle) {
  Triangle t;
  t.size = ivec2(0);
  const vec3 a = corner(job, triangle, 0), b = corner(job, triangle, 1), c = corner(job, triangle, 2);
  t.z = vec3(a.z, b.z, c.z);
  if (!(min(a.z, min(b.z, c.z)) >= push.near_m)) return t;
  const float volume = dot(a, cross(b - a, c - a));
  if (volume == 0.0) return t;
  const float winding = volume < 0.0 ? -1.0 : 1.0;
  const uvec3 number = uvec3(triangles[3u * triangle], triangles[3u * triangle + 1u], triangles[3u * triangle + 2u]);
  t.plane[0] = winding * edge_plane(b, c, number.y < number.z);
  t.plane[1] = winding * edge_plane(c, a, number.z < number.x);
  t.plane[2] = winding * edge_plane(a, b, number.x < number.y);
  const vec2 focal = focal_of(job), centre = centre_of(job), last = vec2(push.width, push.height) - 1.0;
  const vec2 pa = focal * a.xy / a.z + centre, pb = focal * b.xy / b.z + centre, pc = focal * c.xy / c.z + centre;
  // The planes decide; the box must not be smaller by the rounding of a division.
  const float margin_px = 1.0 / 64.0;
  const ivec2 low = ivec2(ceil(clamp(min(pa, min(pb, pc)) - margin_px, vec2(0.0), last + 1.0)));
  const ivec2 high = ivec2(floor(clamp(max(pa, max(pb, pc)) + margin_px, vec2(-1.0), last)));
  // In integers: what comes of a coordinate that is no number must not lie outside the map.
  const uint first_row = gl_WorkGroupID.z * push.band_rows;
  const uvec2 end = uvec2(push.width, min(first_row + push.band_rows, push.height));
  t.low = max(low, ivec2(0, first_row));
  t.size = max(min(high + 1, ivec2(end)) - t.low, ivec2(0));
  return t;
}

// Every `step`-th pixel of the box from `first` on.
void fill(Triangle t, uint job, uint first, uint step) {
  const vec2 focal = focal_of(job), centre = centre_of(job);
  const uint count = uint(t.size.x * t.size.y), map = job * push.width * push.height;
  [[dont_unroll]] for (uint i = first; i < count; i += step) {
    const ivec2 pixel = t.low + ivec2(int(i) % t.size.x, int(i) / t.size.x);
    precise const vec3 ray = vec3((vec2(pixel) - centre) / focal, 1.0);  // the same for small boxes and large
    const vec3 w = vec3(dot_of(t.plane[0], ray), dot_of(t.plane[1], ray), dot_of(t.plane[2], ray));
    const float sum = w.x + w.y + w.z;
    if (min(w.x, min(w.y, w.z)) < 0.0 || sum <= 0.0) continue;
    const float z = dot(w, t.z) / sum;
    atomicMin(depth[map + uint(pixel.y) * push.width + uint(pixel.x)], floatBitsToUint(z));
  }
}

void main() {
  const uint lane = gl_LocalInvocationID.x, job = gl_WorkGroupID.y;
  const uint triangle = push.first_triangle + gl_WorkGroupID.x * DEPTH_GROUP + lane;
  if (lane == 0u) large_count = 0u;
  barrier();
  if (triangle < push.triangle_count) {
    const Triangle t = set_up(job, triangle);
    const int box = t.size.x * t.size.y;
    if (box > int(DEPTH_SMALL_BOX))
      large[atomicAdd(large_count, 1u)] = t;
    else if (box > 0)
      fill(t, job, 0u, 1u);
  }
  barrier();
  const uint count = large_count;
  [[dont_unroll]] for (uint i = 0; i < count; ++i) fill(large[i], job, lane, DEPTH_GROUP);
}
