// An image whose pixels differ from their neighbours.
#pragma once

#include <cstdint>

#include "host/io/image.h"

namespace edgescout::test {

inline Image gradient_image(int width, int height) {
  Image image{width, height, {}};
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x)
      image.pixels.push_back(static_cast<std::uint8_t>((7 * x + 13 * y) % 256));
  return image;
}

}  // namespace edgescout::test
