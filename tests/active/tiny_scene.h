// A rendered scene of one bracket in images of 160 x 120: for tests of where images come from.
#pragma once

#include "host/render/parts.h"
#include "host/render/scene.h"
#include "tests/bare_board.h"

namespace edgescout::test {

inline SimulatedScene tiny_scene(int views = 1) {
  RenderOptions options = bare_board(1, views);
  options.width = 160;
  options.height = 120;
  options.focal_px = 200;
  options.supersampling = 1;
  options.shadows = false;
  const std::vector<Object> parts{make_part("l_bracket")};
  return make_scene(parts, options);
}

}  // namespace edgescout::test
