// Makes the printed board under the parts. Its shapes, words and patterns give edges of their own.
#pragma once

#include "host/core/random.h"
#include "host/core/types.h"

namespace edgescout {

struct PrintOptions {
  int side_px = 64;
  int clutter = 0;  // 0: paper grain only; 1 and 2: increasing amounts of print
  double smallest_px = 0, largest_px = 0;  // size of the printed shapes
  Image texture;  // a photograph of the board's size in place of plain paper; may be empty
};

// Returns albedo * 255 of a square board.
Image print_board(const PrintOptions& options, Random random);

}  // namespace edgescout
