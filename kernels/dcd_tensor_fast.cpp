// The DCD tensor on the CPU, fast: bands of rows that fit the second-level cache, each begun and
// finished by one thread.
//
// A capped distance transform of thin edges is cheapest backwards: instead of asking every pixel
// for its nearest edge, every edge point lowers the values in the disc around it, one 64-byte line
// of a tile at a time.
#include <algorithm>
#include <cmath>
#include <cstring>
#include <tuple>

#include "kernels/dcd_tensor.h"
#include "kernels/error.h"
#include "kernels/simd.h"
#include "kernels/thread_pool.h"

namespace edgescout {

namespace {

constexpr int tile = DCD_TILE;
constexpr int band_rows = 16;

// Distances of a disc, one row for every |dy|, in units of 1/256 px. Each row is padded by a tile
// on both sides, so that a whole line may be read wherever the seed lies in its tile.
struct Stamp {
  int radius;
  int row_stride;
  std::vector<int> half_width;          // last dx below the cap, by |dy|
  std::vector<std::uint16_t> distance;  // [|dy|][dx + radius + tile]
  const std::uint16_t* row(int abs_dy) const {
    return distance.data() + std::size_t(abs_dy) * row_stride + radius + tile;
  }
};

Stamp make_stamp(std::uint16_t cap) {
  Stamp stamp;
  stamp.radius = static_cast<int>(cap / DCD_UNITS_PER_PX);
  stamp.row_stride = 2 * (stamp.radius + tile) + 1;
  stamp.half_width.assign(stamp.radius + 1, -1);
  stamp.distance.assign(std::size_t(stamp.radius + 1) * stamp.row_stride, cap);
  for (int dy = 0; dy <= stamp.radius; ++dy)
    for (int dx = 0; dx <= stamp.radius; ++dx) {
      const double units = std::round(DCD_UNITS_PER_PX * std::sqrt(double(dx * dx + dy * dy)));
      if (units >= cap) break;
      stamp.half_width[dy] = dx;
      std::uint16_t* row =
          stamp.distance.data() + std::size_t(dy) * stamp.row_stride + stamp.radius + tile;
      row[dx] = row[-dx] = static_cast<std::uint16_t>(units);
    }
  return stamp;
}

struct Plan {
  TensorShape shape;
  Stamp stamp;
  std::uint16_t cap, step;
  int second_round;  // bins the recursion still has to visit after one full turn
  std::vector<std::uint16_t> weights;
  std::vector<Seed> seeds;           // by row
  std::vector<std::size_t> row_end;  // seeds of row y: [row_end[y], row_end[y + 1])
};

Plan make_plan(std::span<const EdgePoint> edges, int width, int height,
               const TensorOptions& options) {
  Plan plan;
  plan.shape = {width, height, options.bins};
  plan.cap = static_cast<std::uint16_t>(std::lround(double(DCD_UNITS_PER_PX) * options.cap_px));
  plan.stamp = make_stamp(plan.cap);
  plan.step = orientation_step(options);
  // No value travels further than cap / step bins: it would exceed the cap.
  plan.second_round =
      plan.step == 0 ? options.bins : std::min<int>(options.bins, plan.cap / plan.step + 1);
  plan.weights = smoothing_weights(options.smoothing_variance, options.bins);
  for (const EdgePoint& edge : edges)
    if (const Seed seed = seed_of(edge, plan.shape); seed.bin >= 0) plan.seeds.push_back(seed);
  std::sort(plan.seeds.begin(), plan.seeds.end(), [](const Seed& a, const Seed& b) {
    return std::tie(a.y, a.bin, a.x) < std::tie(b.y, b.bin, b.x);
  });
  plan.seeds.erase(std::unique(plan.seeds.begin(), plan.seeds.end(),
                               [](const Seed& a, const Seed& b) {
                                 return a.x == b.x && a.y == b.y && a.bin == b.bin;
                               }),
                   plan.seeds.end());
  plan.row_end.assign(height + 1, 0);
  for (const Seed& seed : plan.seeds) ++plan.row_end[seed.y + 1];
  for (int y = 0; y < height; ++y) plan.row_end[y + 1] += plan.row_end[y];
  return plan;
}

// Lowers one row of one bin around a seed. `line` is the bin's line in the row's first tile.
EDGESCOUT_SIMD_CLONES
void stamp_row(std::uint16_t* line, std::size_t tile_stride, const std::uint16_t* distance, int x,
               int first_tile, int last_tile) {
  for (int t = first_tile; t <= last_tile; ++t) {
    std::uint16_t* to = line + t * tile_stride;
    const std::uint16_t* from = distance + (t * tile - x);
    for (int i = 0; i < tile; ++i) to[i] = std::min(to[i], from[i]);
  }
}

void stamp_seeds(const Plan& plan, int y0, int y1, std::uint16_t* out) {
  const int radius = plan.stamp.radius, tiles = plan.shape.tiles_per_row();
  const std::size_t tile_stride = std::size_t(plan.shape.bins) * tile,
                    row_stride = tile_stride * tiles;
  const int from = std::max(0, y0 - radius), to = std::min(plan.shape.height, y1 + radius);
  for (std::size_t s = plan.row_end[from]; s < plan.row_end[to]; ++s) {
    const Seed& seed = plan.seeds[s];
    for (int y = std::max(y0, seed.y - radius); y < std::min(y1, seed.y + radius + 1); ++y) {
      const int dy = std::abs(y - seed.y), reach = plan.stamp.half_width[dy];
      if (reach < 0) continue;
      const int first = std::max(0, seed.x - reach) / tile;
      const int last = std::min(plan.shape.width - 1, seed.x + reach) / tile;
      stamp_row(out + y * row_stride + std::size_t(seed.bin) * tile, tile_stride,
                plan.stamp.row(dy), seed.x, first, last);
    }
  }
}

// to = min(to, from + step) without wrapping round at 65535.
inline void relax(std::uint16_t* to, const std::uint16_t* from, std::uint16_t step) {
  const std::uint16_t most = static_cast<std::uint16_t>(65535 - step);
  for (int i = 0; i < tile; ++i) {
    const std::uint16_t sum = static_cast<std::uint16_t>(std::min(from[i], most) + step);
    to[i] = std::min(to[i], sum);
  }
}

// Eqs. 5 and 6 in a tile that sits in the first-level cache. One turn settles everything that does
// not cross bin 0; the second round carries on as far as a value can still count.
EDGESCOUT_SIMD_CLONES
void recurse_tile(std::uint16_t* values, int bins, std::uint16_t step, int second_round) {
  const auto line = [&](int k) { return values + std::size_t(k) * tile; };
  for (int n = 0; n < bins + second_round; ++n)
    relax(line(n % bins), line((n + bins - 1) % bins), step);
  for (int n = bins + second_round - 1; n >= 0; --n)
    relax(line(n % bins), line((n + 1) % bins), step);
}

EDGESCOUT_SIMD_CLONES
void smooth_tile(std::uint16_t* values, int bins, const std::uint16_t* weights, int radius,
                 std::uint16_t* scratch) {
  const std::size_t line_bytes = tile * sizeof(std::uint16_t);
  std::memcpy(scratch, values + std::size_t(bins - radius) * tile, radius * line_bytes);
  std::memcpy(scratch + std::size_t(radius) * tile, values, bins * line_bytes);
  std::memcpy(scratch + std::size_t(radius + bins) * tile, values, radius * line_bytes);
  for (int k = 0; k < bins; ++k) {
    const std::uint16_t* centre = scratch + std::size_t(k + radius) * tile;
    std::uint32_t sum[tile];
    for (int i = 0; i < tile; ++i) sum[i] = (1u << 14) + std::uint32_t(weights[0]) * centre[i];
    for (int d = 1; d <= radius; ++d) {
      const std::uint32_t weight = weights[d];
      const std::uint16_t *before = centre - d * tile, *after = centre + d * tile;
      for (int i = 0; i < tile; ++i) sum[i] += weight * (std::uint32_t(before[i]) + after[i]);
    }
    std::uint16_t* to = values + std::size_t(k) * tile;
    for (int i = 0; i < tile; ++i) to[i] = static_cast<std::uint16_t>(sum[i] >> 15);
  }
}

void finish_band(const Plan& plan, int band, std::uint16_t* out,
                 std::vector<std::uint16_t>& scratch) {
  const int y0 = band * band_rows, y1 = std::min(plan.shape.height, y0 + band_rows);
  const int bins = plan.shape.bins, tiles = plan.shape.tiles_per_row();
  const std::size_t tile_size = std::size_t(bins) * tile;
  std::fill(out + y0 * tiles * tile_size, out + y1 * tiles * tile_size, plan.cap);
  stamp_seeds(plan, y0, y1, out);
  const int radius = static_cast<int>(plan.weights.size()) - 1;
  for (std::size_t t = std::size_t(y0) * tiles; t < std::size_t(y1) * tiles; ++t) {
    std::uint16_t* values = out + t * tile_size;
    recurse_tile(values, bins, plan.step, plan.second_round);
    if (radius > 0) smooth_tile(values, bins, plan.weights.data(), radius, scratch.data());
  }
}

// Padding pixels hold the cap, whatever the stamps left there.
void reset_padding(const TensorShape& shape, std::uint16_t cap, std::uint16_t* out) {
  const int used = shape.width % tile;
  if (used == 0) return;
  for (int y = 0; y < shape.height; ++y)
    for (int k = 0; k < shape.bins; ++k) {
      std::uint16_t* line = out + shape.index(shape.width - 1, y, k) - (used - 1);
      std::fill(line + used, line + tile, cap);
    }
}

}  // namespace

void dcd_tensor_fast(std::span<const EdgePoint> edges, int width, int height,
                     const TensorOptions& options, ThreadPool& pool, std::span<std::uint16_t> out) {
  options.validate();
  const Plan plan = make_plan(edges, width, height, options);
  check(out.size() == plan.shape.size(), "dcd_tensor_fast: output of another size than the tensor");
  const int bands = (height + band_rows - 1) / band_rows;
  pool.for_each(bands, [&](std::size_t band) {
    thread_local std::vector<std::uint16_t> scratch;
    scratch.resize(std::size_t(2) * DCD_MAX_BINS * tile);
    finish_band(plan, static_cast<int>(band), out.data(), scratch);
  });
  reset_padding(plan.shape, plan.cap, out.data());
}

}  // namespace edgescout
