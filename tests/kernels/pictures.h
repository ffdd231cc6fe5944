// Pictures with edges for the tests of the edge detector's paths.
#pragma once

#include <algorithm>
#include <cmath>
#include <random>
#include <string>
#include <vector>

#include "kernels/types.h"

namespace edgescout::test {

struct Picture {
  int width, height;
  std::vector<std::uint8_t> pixels;
  ImageView view() const { return {width, height, pixels.data()}; }
  std::string size() const { return std::to_string(width) + "x" + std::to_string(height); }
};

// Overlapping discs of random grey under a little noise; every third picture is noise alone.
inline Picture random_picture(std::mt19937& rng, int width, int height, bool only_noise) {
  std::uniform_real_distribution<double> unit(0, 1);
  std::normal_distribution<double> noise(0, only_noise ? 60 : 2);
  std::vector<double> grey(std::size_t(width) * height, 110);
  for (int k = 0; k < 10 && !only_noise; ++k) {
    const double cx = unit(rng) * width, cy = unit(rng) * height, r = 2 + unit(rng) * width / 3,
                 level = unit(rng) * 255;
    for (int y = 0; y < height; ++y)
      for (int x = 0; x < width; ++x) {
        const double cover = std::clamp(r - std::hypot(x - cx, y - cy) + 0.5, 0.0, 1.0);
        grey[std::size_t(y) * width + x] += cover * (level - grey[std::size_t(y) * width + x]);
      }
  }
  Picture picture{width, height, {}};
  for (const double g : grey)
    picture.pixels.push_back(
        static_cast<std::uint8_t>(std::clamp(std::round(g + noise(rng)), 0.0, 255.0)));
  return picture;
}

inline std::vector<Picture> random_pictures(std::mt19937& rng) {
  std::vector<Picture> pictures;
  for (const auto& [width, height] : std::vector<std::pair<int, int>>{
           {1, 1}, {7, 5}, {3, 3}, {2, 9}, {33, 17}, {64, 64}, {65, 40}, {141, 67}, {19, 110}})
    for (const bool only_noise : {false, true})
      pictures.push_back(random_picture(rng, width, height, only_noise));
  return pictures;
}

}  // namespace edgescout::test
