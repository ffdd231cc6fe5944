// Makes the printed board under the parts. Its shapes, words and patterns give edges of their own.
#pragma once

#include "host/core/random.h"
#include "host/core/types.h"

namespace edgescout {

// Returns albedo * 255 of a square board, `side_px` wide. `clutter` 0: paper grain only; 1 and 2:
// increasing amounts of print. `smallest_px` and `largest_px` bound the size of the printed shapes.
Image print_board(int side_px, int clutter, double smallest_px, double largest_px, Random random);

}  // namespace edgescout
