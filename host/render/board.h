// The printed board the parts lie on: shapes, words and patterns that produce edges of their own.
#pragma once

#include "host/core/random.h"
#include "host/core/types.h"

namespace edgescout {

// Albedo * 255 of a square board, `side_px` wide. `clutter` 0: paper grain only; 1 and 2: more and
// more print. `smallest_px` and `largest_px` bound the size of what is printed.
Image print_board(int side_px, int clutter, double smallest_px, double largest_px, Random random);

}  // namespace edgescout
