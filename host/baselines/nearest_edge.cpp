#include "host/baselines/nearest_edge.h"

#include <cmath>

#include "kernels/dcd_tensor.h"

namespace edgescout {

namespace {

Seed pixel_of(const EdgePoint& edge, int width, int height) {
  return seed_of(edge, {width, height, TensorOptions{}.bins});
}

// The nearest seed of every pixel in its own column.
void along_columns(NearestEdges& map, std::vector<int>& seed_row) {
  const auto take = [&](int x, int y, int from) {
    const std::size_t here = std::size_t(y) * map.width + x,
                      there = std::size_t(from) * map.width + x;
    if (map.index[there] < 0) return;
    if (map.index[here] >= 0 && std::abs(seed_row[here] - y) <= std::abs(seed_row[there] - y))
      return;
    map.index[here] = map.index[there];
    seed_row[here] = seed_row[there];
  };
  for (int y = 1; y < map.height; ++y)
    for (int x = 0; x < map.width; ++x) take(x, y, y - 1);
  for (int y = map.height - 2; y >= 0; --y)
    for (int x = 0; x < map.width; ++x) take(x, y, y + 1);
}

// Lower envelope of the parabolas of the columns' seeds over one row (Felzenszwalb and
// Huttenlocher, 2012).
void along_row(NearestEdges& map, const std::vector<int>& seed_row, int y) {
  const std::size_t row = std::size_t(y) * map.width;
  const std::vector<std::int32_t> column_seed(map.index.begin() + row,
                                              map.index.begin() + row + map.width);
  const auto height2 = [&](int x) {
    return double(seed_row[row + x] - y) * (seed_row[row + x] - y);
  };
  std::vector<int> apex;     // columns whose parabolas make up the envelope
  std::vector<double> from;  // where each becomes the lowest
  for (int x = 0; x < map.width; ++x) {
    if (column_seed[x] < 0) continue;
    double begin = -1;
    while (!apex.empty()) {
      const int a = apex.back();
      begin = (height2(x) + double(x) * x - height2(a) - double(a) * a) / (2.0 * (x - a));
      if (begin > from.back()) break;
      apex.pop_back();
      from.pop_back();
      begin = -1;
    }
    apex.push_back(x);
    from.push_back(begin);
  }
  for (int x = 0, k = 0; !apex.empty() && x < map.width; ++x) {
    while (k + 1 < int(apex.size()) && from[k + 1] < x) ++k;
    map.index[row + x] = column_seed[apex[k]];
  }
}

}  // namespace

NearestEdges nearest_edges(std::span<const EdgePoint> edges, int width, int height) {
  NearestEdges map{width, height, std::vector<std::int32_t>(std::size_t(width) * height, -1)};
  std::vector<int> seed_row(map.index.size());
  for (std::size_t i = 0; i < edges.size(); ++i) {
    const Seed seed = pixel_of(edges[i], width, height);
    if (seed.bin < 0) continue;
    const std::size_t pixel = std::size_t(seed.y) * width + seed.x;
    if (map.index[pixel] >= 0) continue;
    map.index[pixel] = static_cast<std::int32_t>(i);
    seed_row[pixel] = seed.y;
  }
  along_columns(map, seed_row);
  for (int y = 0; y < height; ++y) along_row(map, seed_row, y);
  return map;
}

ScalarImage distance_image(const NearestEdges& nearest, std::span<const EdgePoint> edges,
                           float far_px) {
  ScalarImage image{nearest.width, nearest.height,
                    std::vector<float>(nearest.index.size(), far_px)};
  for (int y = 0; y < image.height; ++y)
    for (int x = 0; x < image.width; ++x) {
      const std::size_t pixel = std::size_t(y) * image.width + x;
      if (nearest.index[pixel] < 0) continue;
      const Seed seed = pixel_of(edges[nearest.index[pixel]], image.width, image.height);
      image.values[pixel] = std::hypot(float(x - seed.x), float(y - seed.y));
    }
  return image;
}

}  // namespace edgescout
