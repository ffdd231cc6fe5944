// How edge_thin.comp is called (edge_stages.h says what it computes).
//
// One invocation a pixel. A candidate gets its own index as its label, the start of edge_link's
// components; any other pixel EDGE_NO_LABEL.
//
// Buffers: 0 gradient (a word a pixel), 1 labels (a word a pixel).
#ifndef EDGESCOUT_EDGE_THIN_H
#define EDGESCOUT_EDGE_THIN_H

#include "edge_gradient.h"

#ifdef __cplusplus
namespace edgescout {
#endif
EDGESCOUT_CONST(EDGE_NO_LABEL, 0xffffffff);

struct EdgeThinPush {
  uint width;
  uint height;
  uint low2;  // squared threshold, gradient units
};
#ifdef __cplusplus
}  // namespace edgescout
#endif
#endif
