#include "kernels/candidate_map.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "kernels/error.h"
#include "kernels/simd.h"
#include "kernels/thread_pool.h"

namespace edgescout {

namespace {

constexpr int steps = CHAMFER_STEPS_PER_PX;

// To the nearest 1/16 px; exact in float, so that shaders find the same.
int to_steps(float px) { return static_cast<int>(std::floor(px * float(steps) + 0.5f)); }

constexpr int span = 2 * CANDIDATE_MAP_REACH_PX;  // pixels in reach of an edge point along one axis

// A window with room for a whole span on both sides of its rows.
struct Canvas {
  MapWindow window;
  std::size_t stride;
  std::vector<std::uint32_t> words;
  explicit Canvas(const MapWindow& w)
      : window(w), stride(w.width + 2 * span), words(stride * w.height, CANDIDATE_MAP_EMPTY) {}
  std::uint32_t* row(int y) { return words.data() + std::size_t(y - window.y0) * stride + span; }
};

// Offers an edge point to every pixel in its reach: words are ordered by distance, then by number.
// The columns' fixed number is what lets the compiler keep them in vectors.
EDGESCOUT_SIMD_CLONES
void stamp(Canvas& canvas, int x_steps, int y_steps, std::uint32_t number) {
  const MapWindow& window = canvas.window;
  const auto first_in_reach = [](int at) {
    return (at - int(CHAMFER_CAP) + steps * span) / steps - span + 1;
  };
  const int x0 = first_in_reach(x_steps), y0 = std::max(window.y0, first_in_reach(y_steps));
  const int y1 = std::min(window.y0 + int(window.height), first_in_reach(y_steps) + span);
  if (x0 + span <= window.x0 || x0 >= window.x0 + int(window.width)) return;
  std::uint32_t dx2[span];
  for (int i = 0; i < span; ++i) {
    const int dx = steps * (x0 + i) - x_steps;
    dx2[i] = std::uint32_t(dx * dx);
  }
  for (int y = y0; y < y1; ++y) {
    const int dy = steps * y - y_steps;
    std::uint32_t* row = canvas.row(y) + (x0 - window.x0);
    for (int i = 0; i < span; ++i) {
      const std::uint32_t d2 = dx2[i] + std::uint32_t(dy * dy);
      row[i] =
          std::min(row[i], d2 <= CANDIDATE_MAP_REACH2 ? d2 << 16 | number : CANDIDATE_MAP_EMPTY);
    }
  }
}

}  // namespace

MapWindow map_window(float x_min, float y_min, float x_max, float y_max, int width, int height) {
  const auto low = [](float v, int size) {
    return static_cast<int>(
        std::clamp(std::floor(v) - float(CANDIDATE_MAP_REACH_PX), 0.0f, float(size)));
  };
  const auto end = [](float v, int size) {
    return static_cast<int>(
        std::clamp(std::ceil(v) + float(CANDIDATE_MAP_REACH_PX) + 1, 0.0f, float(size)));
  };
  const int x0 = low(x_min, width), y0 = low(y_min, height);
  const int columns = std::max(0, end(x_max, width) - x0),
            rows = std::max(0, end(y_max, height) - y0);
  if (columns == 0 || rows == 0) return {};
  return {x0, y0, static_cast<std::uint32_t>(columns), static_cast<std::uint32_t>(rows)};
}

std::uint32_t chamfer_steps(std::uint32_t word) {
  if (word == CANDIDATE_MAP_EMPTY) return CHAMFER_CAP;
  const std::uint32_t d2 = word >> 16;
  // (v - 1/2)^2 < d2 <= (v + 1/2)^2 in integers; the root's own rounding is off by one at most.
  auto v = static_cast<std::uint32_t>(std::sqrt(static_cast<float>(d2)));
  while (d2 > v * v + v) ++v;
  while (v > 0 && d2 <= v * v - v) --v;
  return v;
}

bool nearest_pixel(float x_px, float y_px, int width, int height, int& x, int& y) {
  if (!(x_px >= -0.5f && y_px >= -0.5f && x_px < float(width) - 0.5f &&
        y_px < float(height) - 0.5f))
    return false;
  // The sum may round up to the next integer just below the border.
  const float right_px = x_px + 0.5f, lower_px = y_px + 0.5f;
  x = std::min(static_cast<int>(right_px), width - 1);
  y = std::min(static_cast<int>(lower_px), height - 1);
  return true;
}

void check_candidate_maps(std::size_t edges, std::span<const CandidateMap> maps, int width,
                          int height, std::size_t pixels) {
  constexpr int most = CANDIDATE_MAP_MAX_SIDE;
  check(width > 0 && height > 0 && width <= most && height <= most,
        "candidate_map: size of the image");
  for (const CandidateMap& map : maps) {
    const MapWindow& w = map.window;
    check(w.x0 >= -most && w.y0 >= -most && w.x0 <= most && w.y0 <= most && w.width <= 2 * most &&
              w.height <= 2 * most,
          "candidate_map: a window far from the image");
    check(map.first_pixel + w.size() <= pixels, "candidate_map: pixels beyond the list");
    check(map.edge_count <= CANDIDATE_MAP_MAX_EDGES, "candidate_map: edge points of a candidate");
    check(std::size_t(map.first_edge) + map.edge_count <= edges,
          "candidate_map: edge points beyond the list");
  }
}

void candidate_map_reference(std::span<const MapEdge> edges, std::span<const CandidateMap> maps,
                             int width, int height, std::span<std::uint32_t> nearest) {
  check_candidate_maps(edges.size(), maps, width, height, nearest.size());
  for (const CandidateMap& map : maps)
    for (std::size_t i = 0; i < map.window.size(); ++i) {
      const int x = map.window.x0 + int(i % map.window.width),
                y = map.window.y0 + int(i / map.window.width);
      std::uint32_t best = CANDIDATE_MAP_EMPTY;
      for (std::uint32_t e = 0; e < map.edge_count; ++e) {
        const MapEdge& edge = edges[map.first_edge + e];
        if (int px, py; !nearest_pixel(edge.x_px, edge.y_px, width, height, px, py)) continue;
        const std::int64_t dx = steps * x - to_steps(edge.x_px),
                           dy = steps * y - to_steps(edge.y_px), d2 = dx * dx + dy * dy;
        if (d2 <= CANDIDATE_MAP_REACH2) best = std::min(best, std::uint32_t(d2) << 16 | e);
      }
      nearest[map.first_pixel + i] = best;
    }
}

void candidate_map_fast(std::span<const MapEdge> edges, std::span<const CandidateMap> maps,
                        int width, int height, std::span<std::uint32_t> nearest, ThreadPool& pool) {
  check_candidate_maps(edges.size(), maps, width, height, nearest.size());
  pool.for_each(maps.size(), [&](std::size_t m) {
    const CandidateMap& map = maps[m];
    const MapWindow& window = map.window;
    Canvas canvas(window);
    for (std::uint32_t e = 0; e < map.edge_count; ++e) {
      const MapEdge& edge = edges[map.first_edge + e];
      if (int x, y; nearest_pixel(edge.x_px, edge.y_px, width, height, x, y))
        stamp(canvas, to_steps(edge.x_px), to_steps(edge.y_px), e);
    }
    for (std::uint32_t r = 0; r < window.height; ++r)
      std::copy_n(canvas.row(window.y0 + int(r)), window.width,
                  nearest.begin() + map.first_pixel + std::size_t(r) * window.width);
  });
}

}  // namespace edgescout
