#version 460
#extension GL_GOOGLE_include_directive : require
#include "dcd_seed.h"
#include "finite.glsl"

layout(constant_id = 0) const uint PASS = DCD_SEED_MARK;
layout(local_size_x = DCD_SEED_GROUP) in;
layout(push_constant) uniform Push { DcdSeedPush push; };
layout(binding = 0) readonly buffer Points { vec4 points[]; };
layout(binding = 1) buffer Planes { uint planes[]; };
layout(binding = 2) buffer Cells { uint cells[]; };
layout(binding = 3) writeonly buffer Seeds { uint seeds[]; };
layout(binding = 4) buffer Slots { uint slots[]; };
layout(binding = 5) buffer Placed { uint placed; };

const uint NO_SLOT = 0xffffffffu;

// Half away from zero, exact: adding 0.5 would round twice.
float round_away(float v) {
  const float whole = trunc(v);
  return abs(v - whole) >= 0.5 ? whole + sign(v) : whole;
}

// Pixel and bin, as seed_of(); false outside the image.
bool seed_of(vec4 point, out uvec2 pixel, out uint bin) {
  pixel = uvec2(0);
  bin = 0;
  if (!finite(point.x) || !finite(point.y) || !finite(point.z)) return false;
  const vec2 at = vec2(round_away(point.x), round_away(point.y));
  if (!(at.x >= 0.0 && at.x < float(push.width) && at.y >= 0.0 && at.y < float(push.height))) return false;
  precise float turns = point.z * push.bins_per_rad;
  const int k = int(round_away(turns));
  pixel = uvec2(at);
  // the remainder of a negative number is undefined, and not the same on all drivers
  bin = k >= 0 ? uint(k) % push.bins : push.bins - 1u - uint(-(k + 1)) % push.bins;
  return true;
}

uint cell_of(uvec2 pixel, uint bin) {
  const uvec2 cell = pixel / DCD_CELL;
  return ((bin * push.cell_rows + cell.y) * push.cell_columns + cell.x) * DCD_SEED_CELL_WORDS;
}

void mark(uint i) {
  slots[i] = NO_SLOT;
  uvec2 pixel;
  uint bin;
  if (!seed_of(points[i], pixel, bin)) return;
  const uint bit = 1u << (pixel.x & 31u);
  const uint word = (bin * push.height + pixel.y) * push.words_per_row + (pixel.x >> 5);
  if ((atomicOr(planes[word], bit) & bit) == 0u) slots[i] = atomicAdd(cells[cell_of(pixel, bin) + 1], 1u);
}

void place_row(uint row) {
  const uint first = row * push.cell_columns * DCD_SEED_CELL_WORDS;
  uint total = 0;
  for (uint c = 0; c < push.cell_columns; ++c) total += cells[first + c * DCD_SEED_CELL_WORDS + 1];
  uint at = atomicAdd(placed, total);
  for (uint c = 0; c < push.cell_columns; ++c) {
    cells[first + c * DCD_SEED_CELL_WORDS] = at;
    at += cells[first + c * DCD_SEED_CELL_WORDS + 1];
  }
}

void fill(uint i) {
  const uint slot = slots[i];
  if (slot == NO_SLOT) return;
  uvec2 pixel;
  uint bin;
  seed_of(points[i], pixel, bin);
  seeds[cells[cell_of(pixel, bin)] + slot] = pixel.x | (pixel.y << 16);
}

void main() {
  const uint i = gl_GlobalInvocationID.x + gl_GlobalInvocationID.y * gl_NumWorkGroups.x * DCD_SEED_GROUP;
  if (PASS == DCD_SEED_OFFSETS) {
    if (i < push.bins * push.cell_rows) place_row(i);
  } else if (i < push.point_count) {
    if (PASS == DCD_SEED_MARK)
      mark(i);
    else
      fill(i);
  }
}
