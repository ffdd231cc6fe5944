#include "kernels/support_map.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "kernels/edge_stages.h"
#include "kernels/error.h"
#include "kernels/thread_pool.h"

namespace edgescout {

namespace {

constexpr int WINDOW = static_cast<int>(SUPPORT_WINDOW), WINDOW_SIZE = 2 * WINDOW + 1;
constexpr int BAND_ROWS = 48;

std::size_t place_in_window(int dx, int dy) {
  return std::size_t(dy + WINDOW) * WINDOW_SIZE + std::size_t(dx + WINDOW);
}

std::uint32_t reach_of(int dx, int dy) {
  std::uint32_t bits = 0;
  for (std::uint32_t b = 0; b < SUPPORT_BINS; ++b) {
    const double angle = std::numbers::pi * b / SUPPORT_BINS;
    const double along = dx * std::cos(angle) + dy * std::sin(angle),
                 beside = dx * std::sin(angle) - dy * std::cos(angle);
    if (std::abs(along) <= SUPPORT_ALONG_PX && std::abs(beside) <= SUPPORT_BESIDE_PX)
      bits |= 1u << b;
  }
  return bits;
}

SupportTables make_tables() {
  SupportTables tables;
  const auto scaled = [](double v) { return static_cast<std::int32_t>(std::lround(16384 * v)); };
  for (std::uint32_t b = 0; b < SUPPORT_BINS; ++b) {
    const double middle = std::numbers::pi * b / SUPPORT_BINS,
                 turn = SUPPORT_MAX_TURN_DEG * std::numbers::pi / 180;
    tables.cones[b] = {scaled(std::cos(middle - turn)), scaled(std::sin(middle - turn)),
                       scaled(std::cos(middle + turn)), scaled(std::sin(middle + turn))};
  }
  for (int dy = -WINDOW; dy <= WINDOW; ++dy)
    for (int dx = -WINDOW; dx <= WINDOW; ++dx)
      tables.reach[place_in_window(dx, dy)] = reach_of(dx, dy);
  return tables;
}

// Of the rows [y0, y1) of the map, from the candidates in reach of them.
void spread_band(std::span<const EdgePixel> candidates, const EdgePlanes& planes, int y0, int y1,
                 std::span<std::uint32_t> map) {
  const auto& reach = support_tables().reach;
  const auto first = std::ranges::lower_bound(candidates, y0 - WINDOW, {}, &EdgePixel::y),
             last = std::ranges::lower_bound(candidates, y1 + WINDOW, {}, &EdgePixel::y);
  for (const EdgePixel& candidate : std::span(first, last)) {
    const std::size_t at = std::size_t(candidate.y) * planes.width + candidate.x;
    const std::uint32_t directions = support_directions(planes.gx[at], planes.gy[at]);
    for (int y = std::max(y0, candidate.y - WINDOW); y < std::min(y1, candidate.y + WINDOW + 1);
         ++y)
      for (int x = std::max(0, candidate.x - WINDOW);
           x < std::min(planes.width, candidate.x + WINDOW + 1); ++x)
        map[std::size_t(y) * planes.width + x] |=
            directions & reach[place_in_window(candidate.x - x, candidate.y - y)];
  }
}

void check_pixels(const ImageView& image) {
  check(image.width > 0 && image.height > 0 && image.pixels,
        "support_map: an image without pixels");
}

}  // namespace

const SupportTables& support_tables() {
  static const SupportTables tables = make_tables();
  return tables;
}

std::uint32_t support_directions(int gx, int gy) {
  std::uint32_t bits = 0;
  const auto& cones = support_tables().cones;
  for (std::uint32_t b = 0; b < SUPPORT_BINS; ++b) {
    const SupportTables::Cone& c = cones[b];
    const std::int32_t low = c.lo_x * gy - c.lo_y * gx, high = gx * c.hi_y - gy * c.hi_x;
    bits |= std::uint32_t((low >= 0 && high >= 0) || (low <= 0 && high <= 0)) << b;
  }
  return bits;
}

std::vector<std::uint32_t> support_map_reference(const ImageView& image) {
  check_pixels(image);
  const auto gradient = edge_gradient_reference(image, edge_weights(SUPPORT_SIGMA_PX));
  const auto candidates = edge_thin_reference(gradient, image.width, image.height,
                                              edge_threshold(SUPPORT_MIN_GRADIENT));
  std::vector<std::uint32_t> map(std::size_t(image.width) * image.height, 0);
  for (int y = 0; y < image.height; ++y)
    for (int x = 0; x < image.width; ++x)
      for (int dy = -WINDOW; dy <= WINDOW; ++dy)
        for (int dx = -WINDOW; dx <= WINDOW; ++dx) {
          if (x + dx < 0 || x + dx >= image.width || y + dy < 0 || y + dy >= image.height) continue;
          const std::size_t q = std::size_t(y + dy) * image.width + x + dx;
          if (!candidates[q]) continue;
          map[std::size_t(y) * image.width + x] |=
              support_directions(gradient[2 * q], gradient[2 * q + 1]) &
              support_tables().reach[place_in_window(dx, dy)];
        }
  return map;
}

std::vector<std::uint32_t> support_map_fast(const ImageView& image, ThreadPool& pool) {
  check_pixels(image);
  EdgePlanes planes(image.width, image.height);
  edge_gradient_fast(image, edge_weights(SUPPORT_SIGMA_PX), pool, planes);
  const std::vector<EdgePixel> candidates =
      edge_thin_fast(edge_threshold(SUPPORT_MIN_GRADIENT), pool, planes);
  std::vector<std::uint32_t> map(std::size_t(image.width) * image.height, 0);
  pool.for_each(std::size_t((image.height + BAND_ROWS - 1) / BAND_ROWS), [&](std::size_t band) {
    const int y0 = static_cast<int>(band) * BAND_ROWS;
    spread_band(candidates, planes, y0, std::min(image.height, y0 + BAND_ROWS), map);
  });
  return map;
}

}  // namespace edgescout
