// How chamfer_masks.comp, chamfer_rows.comp and chamfer_sums.comp are called (chamfer_plan.h says
// what masks and rows are).
//
// Combinations are taken in tiles of whole words of 32, as many as rows fit the device. The three
// run one after the other on a tile: an invocation of the first makes a word of a mask, one of the
// second 32 bytes of a row, one of the third 16 cells of a particle: half a word. All of them
// number their work [mask, row or particle][word or half].
//
// Buffers, masks: 0 masks (ChamferMask), 1 hiders, 2 the candidates' columns ([candidate][word]
// over all combinations), 3 masks' words. Rows: 0 rows (ChamferRow), 1 reach, 2 masks' words, 3 the
// rows' bytes. Sums: 0 particles (ChamferRun), 1 visits (ChamferVisit), 2 rows (ChamferRow), 3
// masks' words, 4 the rows' bytes, 5 sums, 6 counts (unseen << 16 | seen); both
// [particle][combination].
#ifndef EDGESCOUT_CHAMFER_PUSH_H
#define EDGESCOUT_CHAMFER_PUSH_H

#include "interop.h"

#ifdef __cplusplus
namespace edgescout {
#endif
EDGESCOUT_CONST(CHAMFER_GROUP, 64);
EDGESCOUT_CONST(CHAMFER_MASK_WORDS, 3);
EDGESCOUT_CONST(CHAMFER_ROW_WORDS, 3);
EDGESCOUT_CONST(CHAMFER_RUN_WORDS, 5);
EDGESCOUT_CONST(CHAMFER_VISIT_WORDS, 2);
EDGESCOUT_CONST(CHAMFER_NO_MEMBER, 0xffffffffu);
EDGESCOUT_CONST(CHAMFER_QUADS, 8);   // of combinations in a word
EDGESCOUT_CONST(CHAMFER_HALVES, 2);  // of a word, 16 combinations each
EDGESCOUT_CONST(CHAMFER_POINTS_AT_ONCE,
                255);  // whose number fits a byte, and whose distances fit 16 bits

struct ChamferPush {
  uint count;         // masks, rows or particles
  uint words;         // of the tile
  uint first_word;    // of the tile
  uint column_words;  // of all combinations
  uint combinations;
  uint cap;
};
#ifdef __cplusplus
}  // namespace edgescout
#endif
#endif
