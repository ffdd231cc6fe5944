// Edge points -> lists of distinct seeds, sorted into cells: what distance_pass looks through.
//
// A cell is a square of DCD_CELL pixels of one bin; cell (cx, cy) of bin k has the index
//   (k * cell_rows + cy) * cell_columns + cx.
// Three passes of one shader; specialization constant 0 is the pass:
//
// DCD_SEED_MARK, a point each: sets its pixel in the bit plane of its bin, counts the cell where it
// was the first.
//
// DCD_SEED_OFFSETS, a row of cells each: gives every cell its place in the list; the cells of a row
// follow each other.
//
// DCD_SEED_FILL, a point each: writes its pixel, x | y << 16, into its cell's place.
//
// The order inside a cell is not defined; nothing depends on it.
//
// Buffers: 0 points (EdgePoint), 1 bit planes [bin][y][words] (zeroed), 2 cells
// (DCD_SEED_CELL_WORDS words each, zeroed: first seed, count), 3 seeds, 4 slots (a word a point), 5
// one word, zeroed: seeds placed so far.
#ifndef EDGESCOUT_DCD_SEED_H
#define EDGESCOUT_DCD_SEED_H

#include "tensor_layout.h"

#ifdef __cplusplus
namespace edgescout {
#endif
EDGESCOUT_CONST(DCD_CELL, 32);
EDGESCOUT_CONST(DCD_SEED_CELL_WORDS, 2);
EDGESCOUT_CONST(DCD_SEED_GROUP, 64);
EDGESCOUT_CONST(DCD_SEED_MARK, 0);
EDGESCOUT_CONST(DCD_SEED_OFFSETS, 1);
EDGESCOUT_CONST(DCD_SEED_FILL, 2);

struct DcdSeedPush {
  uint point_count;
  uint width;
  uint height;
  uint bins;
  uint words_per_row;
  uint cell_columns;
  uint cell_rows;
  float bins_per_rad;  // bins / pi, rounded to float as seed_of() does
};
#ifdef __cplusplus
}  // namespace edgescout
#endif
#endif
