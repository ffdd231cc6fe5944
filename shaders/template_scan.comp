#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_control_flow_attributes : require
#include "template_score.h"
#include "template_project.h"
#include "template_scan.h"
#include "template_point.glsl"

layout(local_size_x_id = 0) in;
layout(constant_id = 0) const uint GROUP = 8;
layout(push_constant) uniform Push { TemplateScanPush push; };
layout(binding = 0) uniform usamplerBuffer planes;
layout(binding = 1) readonly buffer Points { float points[]; };
layout(binding = 2) readonly buffer Input { uint words[]; };
layout(binding = 3) writeonly buffer Hits { uint hits[]; };

// Lanes share a block out: eight words of four columns across, LANE_ROWS rows, each ROWS times.
const uint LANE_ROWS = GROUP / 8u;
const uint ROWS = TEMPLATE_SCAN_ROWS / LANE_ROWS;
// Of arrays: a length that is specialized is not understood by every driver.
const uint MOST_ROWS = TEMPLATE_SCAN_ROWS;
// So many values of at most TEMPLATE_SCORE_CAP fit into a byte.
const uint POINTS_A_BYTE = 15;

struct Template {
  mat3 rotation;
  vec3 translation_m;
  uint first_point;
  uint point_count;
  vec2 middle;
  ivec2 origin;
  uint columns;
  uint rows;
};

shared ivec2 offsets[TEMPLATE_SCORE_MAX_POINTS];
shared uint bins[TEMPLATE_SCORE_MAX_POINTS];
shared uint sources[TEMPLATE_SCORE_MAX_POINTS];
shared uint near_count;
shared uint best;

float number_at(uint at) { return uintBitsToFloat(words[at]); }

Template read_template(uint region, uint number) {
  const uint turn = number / push.distances, at_distance = number % push.distances;
  const uint viewpoint = turn / push.in_plane_steps;
  const uint pose_at = push.turned_at + 12u * (region * push.turns + turn);
  float m[12];
  [[unroll]] for (uint i = 0u; i < 12u; ++i) m[i] = number_at(pose_at + i);
  const uint region_at = push.regions_at + TEMPLATE_SCAN_REGION_WORDS * region;
  const uint anchors_at =
      push.anchors_at + TEMPLATE_SCAN_ANCHORS_WORDS * (region * push.distances + at_distance);
  const vec3 ray = vec3(number_at(region_at + 2u), number_at(region_at + 3u), number_at(region_at + 4u));
  precise vec3 along = number_at(push.distances_at + at_distance) * ray;
  precise vec3 translation_m = vec3(m[3], m[7], m[11]) + along;
  return Template(mat3(m[0], m[4], m[8], m[1], m[5], m[9], m[2], m[6], m[10]), translation_m,
                  words[2u * viewpoint], words[2u * viewpoint + 1u],
                  vec2(number_at(region_at), number_at(region_at + 1u)),
                  ivec2(int(words[anchors_at]), int(words[anchors_at + 1u])), words[anchors_at + 2u],
                  words[anchors_at + 3u]);
}

// Three of the points' planes, from `first` on.
vec3 read_points(uint first, uint point) {
  const uint at = first * push.point_count + point;
  return vec3(points[at], points[at + push.point_count], points[at + 2u * push.point_count]);
}

void project_points(Template t, uint lane) {
  const vec2 focal = vec2(push.fx, push.fy), centre = vec2(push.cx, push.cy);
  [[dont_unroll]] for (uint i = lane; i < t.point_count; i += GROUP) {
    const vec3 p = t.rotation * read_points(0u, t.first_point + i) + t.translation_m;
    const vec3 q = t.rotation * read_points(3u, t.first_point + i);
    const ImagePoint point = image_point(p, q, focal, centre, t.middle, push.nearest_m, push.bins);
    if (point.is_near) atomicAdd(near_count, 1u);
    offsets[i] = point.offset;
    bins[i] = point.bin;
  }
}

// The word of the block's first four anchors for a point that the first one sees at `at`.
uint source_of(ivec2 at, uint bin) {
  const TemplatePlanesGrid grid = push.planes;
  if (at.x <= -int(grid.left) || at.x >= int(push.width) || at.y <= -int(grid.top) ||
      at.y >= int(push.height))
    return push.bins * grid.rows * grid.anchor_step * grid.stride;
  const uint x = uint(at.x + int(grid.left)), y = uint(at.y + int(grid.top));
  const uint column = x / grid.anchor_step;
  return ((((column & 3u) * (push.bins + 1u) + bin) * grid.rows + y) * grid.anchor_step +
          x % grid.anchor_step) * grid.stride + (column >> 2);
}

// Lowest sum << TEMPLATE_SCAN_ANCHOR_BITS | anchor of this lane's part of a block.
uint best_in_block(Template t, uvec2 block, uint lane) {
  const uint next_row = push.planes.anchor_step * push.planes.anchor_step * push.planes.stride;
  const uint word = lane & 7u, row = lane >> 3, mine = word + row * next_row;
  uint even[MOST_ROWS], odd[MOST_ROWS];  // sums of columns 0 and 2, of 1 and 3
  [[unroll]] for (uint r = 0u; r < ROWS; ++r) even[r] = odd[r] = 0u;
  [[dont_unroll]] for (uint first = 0u; first < t.point_count; first += POINTS_A_BYTE) {
    uint bytes[MOST_ROWS];
    [[unroll]] for (uint r = 0u; r < ROWS; ++r) bytes[r] = 0u;
    const uint end = min(first + POINTS_A_BYTE, t.point_count);
    [[dont_unroll]] for (uint p = first; p < end; ++p) {
      const uint from = sources[p] + mine;
      [[unroll]] for (uint r = 0u; r < ROWS; ++r) bytes[r] += texelFetch(planes, int(from + r * LANE_ROWS * next_row)).x;
    }
    [[unroll]] for (uint r = 0u; r < ROWS; ++r) {
      even[r] += bytes[r] & 0x00ff00ffu;
      odd[r] += bytes[r] >> 8 & 0x00ff00ffu;
    }
  }
  uint least = 0xffffffffu;
  [[unroll]] for (uint r = 0u; r < ROWS; ++r) {
    const uint y = block.y + row + r * LANE_ROWS;
    [[unroll]] for (uint k = 0u; k < 4u; ++k) {
      const uint x = block.x + 4u * word + k;
      const uint sum = ((k & 1u) != 0u ? odd[r] : even[r]) >> (k < 2u ? 0u : 16u) & 0xffffu;
      if (x < t.columns && y < t.rows)
        least = min(least, sum << TEMPLATE_SCAN_ANCHOR_BITS | (y * t.columns + x));
    }
  }
  return least;
}

void main() {
  const uint place = gl_WorkGroupID.x + gl_WorkGroupID.y * gl_NumWorkGroups.x;
  const uint region = gl_WorkGroupID.z, lane = gl_LocalInvocationID.x;
  if (place >= push.templates) return;
  const uint number = words[push.numbers_at + region * push.numbers_a_region + place];
  const bool is_template = number != TEMPLATE_SCAN_NONE;
  Template t = read_template(region, is_template ? number : 0u);
  if (!is_template || t.columns == 0u) t.point_count = 0u;
  if (t.point_count == 0u) t.columns = 0u;
  if (lane == 0u) {
    near_count = 0u;
    best = 0xffffffffu;
  }
  barrier();
  project_points(t, lane);
  const int step = int(push.planes.anchor_step);
  // As many blocks for every template: barriers must not depend on what a buffer holds.
  [[dont_unroll]] for (uint y = 0u; y < push.most_rows; y += TEMPLATE_SCAN_ROWS)
    [[dont_unroll]] for (uint x = 0u; x < push.most_columns; x += TEMPLATE_SCAN_COLUMNS) {
      barrier();
      const ivec2 first = t.origin + step * ivec2(int(x), int(y));
      [[dont_unroll]] for (uint p = lane; p < t.point_count; p += GROUP)
        sources[p] = source_of(first + offsets[p], bins[p]);
      barrier();
      atomicMin(best, best_in_block(t, uvec2(x, y), lane));
    }
  barrier();
  if (lane == 0u)
    hits[region * push.templates + place] = near_count > 0u ? TEMPLATE_SCAN_NONE : best;
}
