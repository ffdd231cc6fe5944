// Lists of seeds -> exact Euclidean distances to the nearest seed of the same bin, capped, 1/256
// px, in the tensor's layout.
//
// One workgroup does one tile of DCD_TILE columns and DISTANCE_ROWS rows of one bin: it reads only
// the cells within the cap, keeps the squared distances of its pixels in registers while the seeds
// go by, and takes the root at the end:
//   D(x) = min(cap, round(256 * sqrt(min_s |x - s|^2))), the rounding made exact in integers.
// Cost: seeds times the area within the cap of each, whatever their arrangement.
//
// Specialization constant 1: rows of invocations in a workgroup, DISTANCE_LEAST_LANE_ROWS or a
// multiple of it, each with an equal share of the tile's rows. With 2 a workgroup has 32
// invocations; 4 fill the 64 that some devices run in step. With fewer, an invocation does more
// pixels for each seed it reads.
//
// Specialization constant 0: seeds looked at in one turn of the loop. lavapipe ends a shader's
// loops after 65,535 turns in all; up to DISTANCE_PLAIN_REACH neighbours a window cannot hold as
// many seeds, beyond it (17 x 17 cells of 32 x 32 px at a cap of 255 px) DISTANCE_MANY at once are
// enough, and some 15 % slower.
//
// Buffers: 0 cells, 1 seeds (dcd_seed.h), 2 tensor, the band of rows [first_row, first_row +
// row_count).
#ifndef EDGESCOUT_DISTANCE_PASS_H
#define EDGESCOUT_DISTANCE_PASS_H

#include "dcd_seed.h"

#ifdef __cplusplus
namespace edgescout {
#endif
EDGESCOUT_CONST(DISTANCE_ROWS, 32);  // of a workgroup
EDGESCOUT_CONST(DISTANCE_LEAST_LANE_ROWS, 2);
EDGESCOUT_CONST(DISTANCE_PLAIN_REACH, 3);
EDGESCOUT_CONST(DISTANCE_MANY, 8);
EDGESCOUT_CONST(DISTANCE_WORDS, 16);  // of a tile's row: two pixels each

struct DistancePassPush {
  uint width;
  uint bins;
  uint tiles_per_row;
  uint first_row;
  uint row_count;
  uint cell_columns;
  uint cell_rows;
  uint reach_cells;  // neighbouring cells that may hold a seed within the cap
  uint cap;          // 1/256 px
};
#ifdef __cplusplus
}  // namespace edgescout
#endif
#endif
