// Stage one, fast: a band of rows at a time, so that the rows between the two passes stay in the
// second-level cache.
#include <algorithm>

#include "kernels/edge_stages.h"
#include "kernels/simd.h"
#include "kernels/thread_pool.h"

namespace edgescout {

namespace {

constexpr int band_rows = 48;
constexpr int chunk = 128;  // pixels whose sums stay in the first-level cache

// `p` may be read `radius` pixels beyond both ends.
EDGESCOUT_SIMD_CLONES
void filter_row(const std::uint8_t* p, int width, const EdgeWeights& weights, std::int16_t* smooth,
                std::int16_t* derivative) {
  for (int x0 = 0; x0 < width; x0 += chunk) {
    const int count = std::min(chunk, width - x0);
    std::int32_t s[chunk], d[chunk];
    for (int x = 0; x < count; ++x) {
      s[x] = 64 + weights.smooth[0] * p[x0 + x];
      d[x] = 64;
    }
    for (int i = 1; i <= weights.radius; ++i) {
      const std::int32_t ws = weights.smooth[i], wd = weights.derivative[i];
      const std::uint8_t *before = p + x0 - i, *after = p + x0 + i;
      for (int x = 0; x < count; ++x) {
        s[x] += ws * (int(before[x]) + after[x]);
        d[x] += wd * (int(after[x]) - before[x]);
      }
    }
    for (int x = 0; x < count; ++x) {
      smooth[x0 + x] = static_cast<std::int16_t>(s[x] >> 7);
      derivative[x0 + x] = static_cast<std::int16_t>(d[x] >> 7);
    }
  }
}

// Filters down the columns; `smooth` and `derivative` point at the row itself, its neighbours lie
// `stride` apart.
EDGESCOUT_SIMD_CLONES
void filter_columns(const std::int16_t* smooth, const std::int16_t* derivative,
                    std::ptrdiff_t stride, int width, const EdgeWeights& weights, std::int16_t* gx,
                    std::int16_t* gy) {
  for (int x0 = 0; x0 < width; x0 += chunk) {
    const int count = std::min(chunk, width - x0);
    std::int32_t sx[chunk], sy[chunk];
    for (int x = 0; x < count; ++x) {
      sx[x] = 8192 + weights.smooth[0] * derivative[x0 + x];
      sy[x] = 8192;
    }
    for (int i = 1; i <= weights.radius; ++i) {
      const std::int32_t ws = weights.smooth[i], wd = weights.derivative[i];
      const std::int16_t *d0 = derivative + x0 - i * stride, *d1 = derivative + x0 + i * stride;
      const std::int16_t *s0 = smooth + x0 - i * stride, *s1 = smooth + x0 + i * stride;
      for (int x = 0; x < count; ++x) {
        sx[x] += ws * (int(d0[x]) + d1[x]);
        sy[x] += wd * (int(s1[x]) - s0[x]);
      }
    }
    for (int x = 0; x < count; ++x) {
      gx[x0 + x] = static_cast<std::int16_t>(sx[x] >> 14);
      gy[x0 + x] = static_cast<std::int16_t>(sy[x] >> 14);
    }
  }
}

struct Scratch {
  std::vector<std::uint8_t> padded;
  std::vector<std::int16_t> smooth, derivative;
};

void filter_band(const ImageView& image, const EdgeWeights& weights, int y0, int y1,
                 Scratch& scratch, EdgePlanes& planes) {
  const int width = image.width, radius = weights.radius, rows = y1 - y0 + 2 * radius;
  scratch.padded.resize(std::size_t(width) + 2 * radius);
  scratch.smooth.resize(std::size_t(rows) * width);
  scratch.derivative.resize(std::size_t(rows) * width);
  for (int r = 0; r < rows; ++r) {
    const std::uint8_t* row =
        image.pixels + std::size_t(std::clamp(y0 - radius + r, 0, image.height - 1)) * width;
    std::fill_n(scratch.padded.begin(), radius, row[0]);
    std::copy_n(row, width, scratch.padded.begin() + radius);
    std::fill_n(scratch.padded.begin() + radius + width, radius, row[width - 1]);
    filter_row(scratch.padded.data() + radius, width, weights,
               scratch.smooth.data() + std::size_t(r) * width,
               scratch.derivative.data() + std::size_t(r) * width);
  }
  for (int y = y0; y < y1; ++y) {
    const std::size_t from = std::size_t(y - y0 + radius) * width, to = std::size_t(y) * width;
    filter_columns(scratch.smooth.data() + from, scratch.derivative.data() + from, width, width,
                   weights, planes.gx.data() + to, planes.gy.data() + to);
  }
}

}  // namespace

void edge_gradient_fast(const ImageView& image, const EdgeWeights& weights, ThreadPool& pool,
                        EdgePlanes& planes) {
  const int bands = (image.height + band_rows - 1) / band_rows;
  pool.for_each(bands, [&](std::size_t band) {
    thread_local Scratch scratch;
    const int y0 = static_cast<int>(band) * band_rows;
    filter_band(image, weights, y0, std::min(image.height, y0 + band_rows), scratch, planes);
  });
}

}  // namespace edgescout
