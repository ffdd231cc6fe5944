// How candidate_map.comp is called (candidate_map.h says what it computes).
//
// A workgroup takes a tile of CANDIDATE_TILE x CANDIDATE_TILE pixels of one window. It picks,
// CANDIDATE_EDGES_AT_ONCE at a time, the edge points within reach of the tile; then every
// invocation tries those on its pixels.
//
// Buffers: 0 edge points (MapEdge), 1 maps (CandidateMap), 2 tiles (two words: map, row << 16 |
// column of the tile in the window), 3 the pixels' words.
#ifndef EDGESCOUT_CANDIDATE_MAP_PUSH_H
#define EDGESCOUT_CANDIDATE_MAP_PUSH_H

#include "candidate_map.h"

#ifdef __cplusplus
namespace edgescout {
#endif
EDGESCOUT_CONST(CANDIDATE_GROUP, 64);
EDGESCOUT_CONST(CANDIDATE_TILE, 16);
EDGESCOUT_CONST(CANDIDATE_EDGES_AT_ONCE, 256);
EDGESCOUT_CONST(CANDIDATE_MAP_WORDS, 7);
EDGESCOUT_CONST(MAP_EDGE_WORDS, 3);

struct CandidateMapPush {
  uint tile_count;
  uint width;  // of the image
  uint height;
  uint most_edges;  // of a map
};
#ifdef __cplusplus
}  // namespace edgescout
#endif
#endif
