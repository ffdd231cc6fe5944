// Stage two, fast: all eight neighbours are read and the right ones chosen by masks, so that a row
// runs in vectors.
#include <algorithm>
#include <bit>
#include <cstdlib>
#include <cstring>

#include "kernels/edge_stages.h"
#include "kernels/simd.h"
#include "kernels/thread_pool.h"

namespace edgescout {

namespace {

constexpr int band_rows = 48;

EDGESCOUT_SIMD_CLONES
void square_row(const std::int16_t* gx, const std::int16_t* gy, int width, std::uint32_t* m2) {
  for (int x = 0; x < width; ++x)
    m2[x] = static_cast<std::uint32_t>(int(gx[x]) * gx[x] + int(gy[x]) * gy[x]);
}

// Squared magnitudes of the rows above, at and below; marks the pixels 1 .. width - 2.
struct ThinRow {
  const std::int16_t *gx, *gy;
  const std::uint32_t *above, *here, *below;
};

// yes where the mask is all ones, no where it is zero. A ?: here would become a branch, and
// branches keep loops from vectors.
inline std::uint32_t choose(std::uint32_t mask, std::uint32_t yes, std::uint32_t no) {
  return (yes & mask) | (no & ~mask);
}

[[gnu::always_inline]] inline void thin_span(const ThinRow& row, int x0, int x1, std::uint32_t low2,
                                             std::uint8_t* marks) {
  const std::int16_t *gx = row.gx, *gy = row.gy;
  const std::uint32_t *above = row.above, *here = row.here, *below = row.below;
  for (int x = x0; x < x1; ++x) {
    const std::int32_t dx = gx[x], dy = gy[x], ax = std::abs(dx), ay = std::abs(dy);
    const std::int32_t larger = std::max(std::max(ax, ay), 1), smaller = std::min(ax, ay);
    // The quotient of two such integers is never so close below a whole number that its rounding in
    // float reaches it.
    const std::int32_t dividend = 256 * smaller + larger / 2;
    const auto f = static_cast<std::uint32_t>(
        static_cast<std::int32_t>(static_cast<float>(dividend) / static_cast<float>(larger)));
    const auto right = ~static_cast<std::uint32_t>(dx >> 31),
               down = ~static_cast<std::uint32_t>(dy >> 31);
    const auto level = ~static_cast<std::uint32_t>((ax - ay) >> 31);
    const std::uint32_t west = here[x - 1], east = here[x + 1], north = above[x], south = below[x];
    const std::uint32_t nw = above[x - 1], ne = above[x + 1], sw = below[x - 1], se = below[x + 1],
                        centre = here[x];
    const std::uint32_t near_ahead =
        choose(level, choose(right, east, west), choose(down, south, north)) >> 6;
    const std::uint32_t near_behind =
        choose(level, choose(right, west, east), choose(down, north, south)) >> 6;
    const std::uint32_t far_ahead = choose(down, choose(right, se, sw), choose(right, ne, nw)) >> 6;
    const std::uint32_t far_behind =
        choose(down, choose(right, nw, ne), choose(right, sw, se)) >> 6;
    const std::uint32_t before = (256 - f) * near_behind + f * far_behind,
                        after = (256 - f) * near_ahead + f * far_ahead;
    const std::uint32_t scaled = 256 * (centre >> 6);
    marks[x] = static_cast<std::uint8_t>((centre >= low2) & (scaled > before) & (scaled >= after));
  }
}

// Most of an image is flat: spans without a strong pixel are left alone.
EDGESCOUT_SIMD_CLONES
void thin_row(const ThinRow& row, int width, std::uint32_t low2, std::uint8_t* marks) {
  constexpr int span = 64;
  for (int x0 = 1; x0 < width - 1; x0 += span) {
    const int x1 = std::min(x0 + span, width - 1);
    std::uint32_t strongest = 0;
    for (int x = x0; x < x1; ++x) strongest = std::max(strongest, row.here[x]);
    if (strongest >= low2) thin_span(row, x0, x1, low2, marks);
  }
}

void list_row(const std::uint8_t* marks, const std::uint32_t* m2, int width, int y,
              std::vector<EdgePixel>& pixels) {
  for (int x = 0; x < width; x += 8) {
    std::uint64_t eight;
    std::memcpy(&eight, marks + x, sizeof eight);  // runs into the margin, which holds zeros
    for (; eight; eight &= eight - 1)
      if (const int at = x + std::countr_zero(eight) / 8; at < width)
        pixels.push_back({at, y, m2[at]});
  }
}

void thin_band(int y0, int y1, std::uint32_t low2, EdgePlanes& planes,
               std::vector<EdgePixel>& pixels) {
  thread_local std::vector<std::uint32_t> squares;
  const int width = planes.width;
  squares.resize(std::size_t(3) * width);
  const auto row_of = [&](int y) { return squares.data() + std::size_t(y % 3) * width; };
  const auto square = [&](int y) {
    square_row(planes.gx.data() + std::size_t(y) * width, planes.gy.data() + std::size_t(y) * width,
               width, row_of(y));
  };
  y0 = std::max(y0, 1);
  y1 = std::min(y1, planes.height - 1);
  if (y0 >= y1) return;
  square(y0 - 1);
  square(y0);
  for (int y = y0; y < y1; ++y) {
    square(y + 1);
    const std::size_t at = std::size_t(y) * width;
    std::uint8_t* marks = planes.candidates.data() + planes.candidate_index(0, y);
    thin_row(
        {planes.gx.data() + at, planes.gy.data() + at, row_of(y - 1), row_of(y), row_of(y + 1)},
        width, low2, marks);
    list_row(marks, row_of(y), width, y, pixels);
  }
}

}  // namespace

EdgePlanes::EdgePlanes(int image_width, int image_height)
    : width(image_width),
      height(image_height),
      gx(std::size_t(image_width) * image_height),
      gy(std::size_t(image_width) * image_height),
      candidates(stride() * (std::size_t(image_height) + 2 * EDGE_WINDOW) + 8) {}

std::vector<EdgePixel> edge_thin_fast(std::int32_t low, ThreadPool& pool, EdgePlanes& planes) {
  const int bands = (planes.height + band_rows - 1) / band_rows;
  std::vector<std::vector<EdgePixel>> lists(bands);
  pool.for_each(bands, [&](std::size_t band) {
    const int y0 = static_cast<int>(band) * band_rows;
    thin_band(y0, std::min(planes.height, y0 + band_rows), static_cast<std::uint32_t>(low * low),
              planes, lists[band]);
  });
  std::vector<EdgePixel> pixels;
  std::size_t total = 0;
  for (const auto& list : lists) total += list.size();
  pixels.reserve(total);
  for (const auto& list : lists) pixels.insert(pixels.end(), list.begin(), list.end());
  return pixels;
}

}  // namespace edgescout
