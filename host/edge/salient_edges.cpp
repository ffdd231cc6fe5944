#include "host/edge/salient_edges.h"

#include <algorithm>
#include <cmath>

namespace edgescout {

namespace {

float strong_quantile(std::span<const EdgePoint> edges) {
  std::vector<float> strengths;
  for (const EdgePoint& edge : edges) strengths.push_back(edge.strength);
  const auto at = strengths.begin() + static_cast<std::ptrdiff_t>(strengths.size() * 95 / 100);
  std::nth_element(strengths.begin(), at, strengths.end());
  return *at;
}

// A number in [0, 1) that depends on the place. It thins edges of equal strength evenly and equally
// in every run.
double scattered(const EdgePoint& edge) {
  return std::fmod(12.9898 * edge.x_px + 78.233 * edge.y_px, 1.0);
}

bool stronger(const EdgePoint& a, const EdgePoint& b) {
  return a.strength != b.strength ? a.strength > b.strength : scattered(a) < scattered(b);
}

}  // namespace

std::vector<EdgePoint> salient_edges(std::span<const EdgePoint> edges, int width, int height,
                                     const SalientOptions& options) {
  if (edges.empty()) return {};
  const int block = options.block_px, columns = (width + block - 1) / block,
            rows = (height + block - 1) / block;
  const float least = float(options.min_strength) * strong_quantile(edges);
  std::vector<std::vector<EdgePoint>> blocks(std::size_t(columns) * rows);
  for (const EdgePoint& edge : edges) {
    const int column = std::clamp(int(edge.x_px) / block, 0, columns - 1),
              row = std::clamp(int(edge.y_px) / block, 0, rows - 1);
    if (edge.strength >= least) blocks[std::size_t(row) * columns + column].push_back(edge);
  }
  std::vector<EdgePoint> salient;
  for (int row = 0; row < rows; ++row)
    for (int column = 0; column < columns; ++column) {
      std::vector<EdgePoint>& here = blocks[std::size_t(row) * columns + column];
      const int w = std::min(block, width - column * block),
                h = std::min(block, height - row * block);
      const std::size_t most = std::min(here.size(), std::size_t(options.max_density * w * h));
      std::partial_sort(here.begin(), here.begin() + std::ptrdiff_t(most), here.end(), stronger);
      salient.insert(salient.end(), here.begin(), here.begin() + std::ptrdiff_t(most));
    }
  return salient;
}

}  // namespace edgescout
