#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_control_flow_attributes : require
#include "candidate_map_push.h"
#include "finite.glsl"

layout(local_size_x = CANDIDATE_GROUP) in;
layout(push_constant) uniform Push { CandidateMapPush push; };
layout(binding = 0) readonly buffer Edges { float edges[]; };
layout(binding = 1) readonly buffer Maps { uint maps[]; };
layout(binding = 2) readonly buffer Tiles { uint tiles[]; };
layout(binding = 3) writeonly buffer Nearest { uint nearest[]; };

const int STEPS = int(CHAMFER_STEPS_PER_PX);
const uint PIXELS = CANDIDATE_TILE * CANDIDATE_TILE / CANDIDATE_GROUP;  // of an invocation

shared uint picked_count;
shared ivec3 picked[CANDIDATE_EDGES_AT_ONCE];  // place in steps, number

bool in_image(vec2 p) {
  return p.x >= -0.5 && p.y >= -0.5 && p.x < float(push.width) - 0.5 && p.y < float(push.height) - 0.5;
}

// Whether the place lies within reach of the tile's pixel centres, `low` to `high` steps.
bool reaches(ivec2 place, ivec2 low, ivec2 high) {
  const ivec2 d = max(max(low - place, place - high), ivec2(0));
  return d.x < STEPS * int(CANDIDATE_MAP_REACH_PX) && d.y < STEPS * int(CANDIDATE_MAP_REACH_PX) &&
         uint(d.x * d.x + d.y * d.y) <= CANDIDATE_MAP_REACH2;
}

void pick(uint first_edge, uint begin, uint end, ivec2 low, ivec2 high) {
  [[dont_unroll]] for (uint e = begin + gl_LocalInvocationID.x; e < end; e += CANDIDATE_GROUP) {
    const uint at = (first_edge + e) * MAP_EDGE_WORDS;
    const vec2 p = vec2(edges[at], edges[at + 1]);
    if (!finite(p.x) || !finite(p.y) || !in_image(p)) continue;
    const ivec2 place = ivec2(floor(p * float(STEPS) + 0.5));
    if (reaches(place, low, high)) picked[atomicAdd(picked_count, 1u)] = ivec3(place, int(e));
  }
}

void main() {
  const uint t = gl_WorkGroupID.x + gl_WorkGroupID.y * gl_NumWorkGroups.x;
  if (t >= push.tile_count) return;
  const uint lane = gl_LocalInvocationID.x, at = tiles[2u * t] * CANDIDATE_MAP_WORDS;
  const uvec2 size = uvec2(maps[at + 2u], maps[at + 3u]);
  const uint first_edge = maps[at + 5u], edge_count = maps[at + 6u];
  const uvec2 corner = CANDIDATE_TILE * uvec2(tiles[2u * t + 1u] & 0xffffu, tiles[2u * t + 1u] >> 16);
  const ivec2 low = STEPS * (ivec2(int(maps[at]), int(maps[at + 1u])) + ivec2(corner));
  const ivec2 high = low + STEPS * int(CANDIDATE_TILE - 1u);
  const uvec2 mine = uvec2(lane % CANDIDATE_TILE, lane / CANDIDATE_TILE);
  const uint down = CANDIDATE_GROUP / CANDIDATE_TILE;
  uint best[PIXELS];
  [[unroll]] for (uint k = 0u; k < PIXELS; ++k) best[k] = CANDIDATE_MAP_EMPTY;
  // As many turns for every map: barriers must not depend on what a buffer holds.
  [[dont_unroll]] for (uint begin = 0u; begin < push.most_edges; begin += CANDIDATE_EDGES_AT_ONCE) {
    if (lane == 0u) picked_count = 0u;
    barrier();
    pick(first_edge, begin, min(edge_count, begin + CANDIDATE_EDGES_AT_ONCE), low, high);
    barrier();
    const uint count = picked_count;
    [[dont_unroll]] for (uint i = 0u; i < count; ++i) {
      const ivec3 edge = picked[i];
      const ivec2 d = low + STEPS * ivec2(mine) - edge.xy;
      [[unroll]] for (uint k = 0u; k < PIXELS; ++k) {
        const int dy = d.y + STEPS * int(k * down);
        const uint d2 = uint(d.x * d.x + dy * dy);
        if (d2 <= CANDIDATE_MAP_REACH2) best[k] = min(best[k], d2 << 16 | uint(edge.z));
      }
    }
    barrier();
  }
  [[unroll]] for (uint k = 0u; k < PIXELS; ++k) {
    const uvec2 p = corner + mine + uvec2(0u, k * down);
    if (p.x < size.x && p.y < size.y) nearest[maps[at + 4u] + p.y * size.x + p.x] = best[k];
  }
}
