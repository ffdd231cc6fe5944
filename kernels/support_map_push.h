// How support_map.comp is called (support_map.h says what it computes).
//
// One invocation a pixel; specialization constant 0 is the pass: SUPPORT_DIRECTIONS leaves the
// directions of every candidate, SUPPORT_SPREAD the map.
//
// Buffers: 0 gradient (edge_gradient.h), 1 labels (edge_thin.h), 2 tables (SupportTables, word by
// word), 3 directions (a word a pixel), 4 map (a word a pixel).
#ifndef EDGESCOUT_SUPPORT_MAP_PUSH_H
#define EDGESCOUT_SUPPORT_MAP_PUSH_H

#include "interop.h"

#ifdef __cplusplus
namespace edgescout {
#endif
EDGESCOUT_CONST(SUPPORT_MAP_GROUP, 64);
EDGESCOUT_CONST(SUPPORT_DIRECTIONS, 0);
EDGESCOUT_CONST(SUPPORT_SPREAD, 1);

struct SupportMapPush {
  uint width;
  uint height;
};
#ifdef __cplusplus
}  // namespace edgescout
#endif
#endif
