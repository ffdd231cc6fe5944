#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_control_flow_attributes : require
#include "distance_pass.h"

layout(local_size_x = DISTANCE_WORDS, local_size_y_id = 1) in;
layout(constant_id = 0) const uint SEEDS_AT_ONCE = 1;
layout(constant_id = 1) const uint LANE_ROWS = 2;
layout(push_constant) uniform Push { DistancePassPush push; };
layout(binding = 0) readonly buffer Cells { uvec2 cells[]; };
layout(binding = 1) readonly buffer Seeds { uint seeds[]; };
layout(binding = 2) writeonly buffer Tensor { uint tensor[]; };

const uint ROWS = DISTANCE_ROWS / LANE_ROWS;
// Of arrays: a length that is specialized is not understood by every driver.
const uint MOST_ROWS = DISTANCE_ROWS / DISTANCE_LEAST_LANE_ROWS;
const int FAR = 1 << 28;

// round(256 * sqrt(v)) for v < 2^16. The float root may be off by one unit; q is right where (q -
// 1/2)^2 < 2^16 v < (q + 1/2)^2, in integers q^2 - q < 2^16 v <= q^2 + q.
uint root(uint v) {
  uint q = uint(sqrt(float(v)) * 256.0 + 0.5);
  const uint scaled = v << 16;
  if (q * q + q < scaled)
    ++q;
  else if (q > 0u && q * q - q >= scaled)
    --q;
  return q;
}

// The pixels of this invocation: a column of the left and one of the right of each word.
int left[MOST_ROWS], right[MOST_ROWS];

// |x - s|^2 = dx^2 + sy^2 - 2 r sy + r^2 with sy counted from row y: r^2 is the same for all seeds
// and is added last.
void look_at(uint seed, int x, int y) {
  const int dx = x - int(seed & 0xffffu), sy = int(seed >> 16) - y;
  int a = dx * dx + sy * sy, b = a + 2 * dx + 1;
  const int less = 2 * sy;
  [[unroll]] for (uint r = 0; r < ROWS; ++r) {
    left[r] = min(left[r], a);
    right[r] = min(right[r], b);
    a -= less;
    b -= less;
  }
}

uint distance_of(int squared) { return min(push.cap, root(uint(min(squared, 65535)))); }

void main() {
  const uint bin = gl_WorkGroupID.z, tile = gl_WorkGroupID.x;
  const uint strip_row = push.first_row + gl_WorkGroupID.y * DISTANCE_ROWS;
  const int x = int(tile * DCD_TILE + gl_LocalInvocationID.x * 2u);
  const int y = int(strip_row + gl_LocalInvocationID.y * ROWS);

  [[unroll]] for (uint r = 0; r < ROWS; ++r) left[r] = right[r] = FAR;

  const uint x_end = min(tile + push.reach_cells + 1u, push.cell_columns) - 1u, x_begin = tile - min(tile, push.reach_cells);
  const uint strip_cell = strip_row / DCD_CELL, last_cell = min(strip_row + DISTANCE_ROWS - 1u, push.cell_rows * DCD_CELL - 1u) / DCD_CELL;
  const uint y_begin = strip_cell - min(strip_cell, push.reach_cells), y_end = min(last_cell + push.reach_cells, push.cell_rows - 1u);
  bool any = false;
  [[dont_unroll]] for (uint cy = y_begin; cy <= y_end; ++cy) {
    const uint row = (bin * push.cell_rows + cy) * push.cell_columns;
    const uint begin = cells[row + x_begin].x;
    const uvec2 last = cells[row + x_end];
    const uint end = last.x + last.y;
    any = any || begin < end;
    uint i = begin;
    [[dont_unroll]] for (; i + SEEDS_AT_ONCE <= end; i += SEEDS_AT_ONCE)
      [[unroll]] for (uint k = 0; k < SEEDS_AT_ONCE; ++k) look_at(seeds[i + k], x, y);
    [[dont_unroll]] for (; i < end; ++i) look_at(seeds[i], x, y);
  }

  const uint band_row = uint(y) - push.first_row;
  [[unroll]] for (uint r = 0; r < ROWS; ++r) {
    uint low = push.cap, high = push.cap;
    if (any) {  // most windows of a bin are empty
      const int add = int(r * r);
      if (uint(x) < push.width) low = distance_of(left[r] + add);
      if (uint(x) + 1u < push.width) high = distance_of(right[r] + add);
    }
    const uint line = ((band_row + r) * push.tiles_per_row + tile) * push.bins + bin;
    if (band_row + r < push.row_count) tensor[line * DISTANCE_WORDS + gl_LocalInvocationID.x] = low | (high << 16);
  }
}
