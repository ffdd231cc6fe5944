// The DCD tensor as it is defined, plainly: the judge of the fast path and of the device.
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>

#include "kernels/dcd_tensor.h"

namespace edgescout {

namespace {

constexpr std::int64_t far_away = std::int64_t{1} << 40;

// Squared distance to the nearest seed of one bin: rows first, then the minimum over each column.
std::vector<std::int64_t> squared_distances(const std::vector<char>& seeds, int width, int height) {
  std::vector<std::int64_t> row_distance(seeds.size(), far_away), result(seeds.size(), far_away);
  for (int y = 0; y < height; ++y) {
    const std::size_t row = std::size_t(y) * width;
    std::int64_t since = far_away;
    for (int x = 0; x < width; ++x)
      row_distance[row + x] = since = seeds[row + x] ? 0 : std::min(far_away, since + 1);
    since = far_away;
    for (int x = width - 1; x >= 0; --x) {
      since = seeds[row + x] ? 0 : std::min(far_away, since + 1);
      row_distance[row + x] = std::min(row_distance[row + x], since);
    }
  }
  for (int x = 0; x < width; ++x)
    for (int from = 0; from < height; ++from) {
      const std::int64_t g = row_distance[std::size_t(from) * width + x];
      if (g >= far_away) continue;
      for (int y = 0; y < height; ++y) {
        std::int64_t& value = result[std::size_t(y) * width + x];
        value = std::min(value, g * g + std::int64_t(y - from) * (y - from));
      }
    }
  return result;
}

// Eqs. 5 and 6, round and round until nothing changes.
void recurse(std::vector<std::uint32_t>& column, std::uint32_t step) {
  const int bins = static_cast<int>(column.size());
  for (bool changed = true; changed;) {
    changed = false;
    const auto relax = [&](int to, int from) {
      if (column[from] + step < column[to]) column[to] = column[from] + step, changed = true;
    };
    for (int k = 0; k < bins; ++k) relax(k, (k + bins - 1) % bins);
    for (int k = bins - 1; k >= 0; --k) relax(k, (k + 1) % bins);
  }
}

std::vector<std::uint32_t> smooth(const std::vector<std::uint32_t>& column,
                                  const std::vector<std::uint16_t>& weights) {
  const int bins = static_cast<int>(column.size()), radius = static_cast<int>(weights.size()) - 1;
  std::vector<std::uint32_t> smoothed(column.size());
  for (int k = 0; k < bins; ++k) {
    std::uint32_t sum = 1u << 14;
    for (int d = -radius; d <= radius; ++d)
      sum += weights[std::abs(d)] * column[(k + d + bins) % bins];
    smoothed[k] = sum >> 15;
  }
  return smoothed;
}

}  // namespace

std::vector<std::uint16_t> dcd_tensor_reference(std::span<const EdgePoint> edges, int width,
                                                int height, const TensorOptions& options) {
  options.validate();
  const TensorShape shape{width, height, options.bins};
  const auto cap =
      static_cast<std::uint32_t>(std::lround(double(DCD_UNITS_PER_PX) * options.cap_px));
  std::vector<std::uint16_t> tensor(shape.size(), static_cast<std::uint16_t>(cap));
  for (int bin = 0; bin < shape.bins; ++bin) {
    std::vector<char> seeds(std::size_t(width) * height, 0);
    for (const EdgePoint& edge : edges)
      if (const Seed seed = seed_of(edge, shape); seed.bin == bin)
        seeds[std::size_t(seed.y) * width + seed.x] = 1;
    const std::vector<std::int64_t> squared = squared_distances(seeds, width, height);
    for (int y = 0; y < height; ++y)
      for (int x = 0; x < width; ++x) {
        const double units =
            std::round(DCD_UNITS_PER_PX * std::sqrt(double(squared[std::size_t(y) * width + x])));
        tensor[shape.index(x, y, bin)] = static_cast<std::uint16_t>(std::min(double(cap), units));
      }
  }
  const std::vector<std::uint16_t> weights =
      smoothing_weights(options.smoothing_variance, options.bins);
  std::vector<std::uint32_t> column(shape.bins);
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) {
      for (int k = 0; k < shape.bins; ++k) column[k] = tensor[shape.index(x, y, k)];
      recurse(column, orientation_step(options));
      const std::vector<std::uint32_t> smoothed = smooth(column, weights);
      for (int k = 0; k < shape.bins; ++k)
        tensor[shape.index(x, y, k)] = static_cast<std::uint16_t>(smoothed[k]);
    }
  return tensor;
}

}  // namespace edgescout
