// Candidates, particles and combinations seen from one view, for the tests of the next-best-view
// kernels: random ones, which need not be anything a camera could see, and boxes, which a test can
// draw by itself.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <random>
#include <vector>

#include "kernels/combination_chamfer.h"
#include "kernels/depth_raster.h"

namespace edgescout::test {

struct ChamferInput {
  int width = 0, height = 0;
  std::vector<MapEdge> edges;
  std::vector<CandidateMap> maps;
  std::vector<std::uint32_t> nearest;
  std::vector<float> surface_m, tolerance_m;
  std::vector<ParticlePoint> points;
  std::vector<std::uint32_t> first_point{0};
  std::uint32_t combination_count = 0;
  std::vector<std::uint32_t> words;

  ChamferView view() const {
    return {width, height, maps, edges, nearest, surface_m, tolerance_m, points, first_point};
  }
  CombinationBits combinations() const {
    return {combination_count, static_cast<std::uint32_t>(maps.size()), words};
  }

  // One candidate, its surface depths still empty.
  void add_candidate(const MapWindow& window, const std::vector<MapEdge>& own, float tolerance) {
    maps.push_back({window, static_cast<std::uint32_t>(surface_m.size()),
                    static_cast<std::uint32_t>(edges.size()),
                    static_cast<std::uint32_t>(own.size())});
    edges.insert(edges.end(), own.begin(), own.end());
    surface_m.resize(surface_m.size() + window.size(), DEPTH_EMPTY);
    tolerance_m.push_back(tolerance);
  }
  void add_particle(const std::vector<ParticlePoint>& own) {
    points.insert(points.end(), own.begin(), own.end());
    first_point.push_back(static_cast<std::uint32_t>(points.size()));
  }
  void draw_maps() {
    nearest.resize(surface_m.size());
    candidate_map_reference(edges, maps, width, height, nearest);
  }
  // Every candidate with a chance of `density`; the first combination is empty.
  void draw_combinations(std::mt19937& rng, std::uint32_t count, double density) {
    combination_count = count;
    const std::size_t row = combinations().row_words();
    words.assign(count * row, 0);
    std::bernoulli_distribution member(density);
    for (std::uint32_t j = 1; j < count; ++j)
      for (std::uint32_t c = 0; c < maps.size(); ++c)
        words[j * row + c / 32] |= std::uint32_t(member(rng)) << (c % 32);
  }
};

struct ChamferInputSize {
  int width, height, candidates, edges, particles, points;
  std::uint32_t combinations;
};

// Windows, edges and points in and out of the image and of each other, surfaces full of holes,
// edges at equal distances.
inline ChamferInput random_chamfer_input(std::mt19937& rng, const ChamferInputSize& size) {
  const auto in = [&](float low, float high) {
    return std::uniform_real_distribution<float>(low, high)(rng);
  };
  const auto whole = [&](int low, int high) {
    return std::uniform_int_distribution<int>(low, high)(rng);
  };
  ChamferInput input;
  input.width = size.width;
  input.height = size.height;
  for (int c = 0; c < size.candidates; ++c) {
    std::vector<MapEdge> own;
    const float x = in(0, float(size.width)), y = in(0, float(size.height)), reach = in(1, 12);
    for (int e = whole(0, size.edges); e > 0; --e) {
      const MapEdge edge{x + in(-reach, reach), y + in(-reach, reach), in(0.3f, 0.6f)};
      own.push_back(e % 3 == 0 ? MapEdge{std::round(edge.x_px), std::round(edge.y_px), edge.z_m}
                               : edge);
    }
    input.add_candidate({int(x) - whole(0, 30), int(y) - whole(0, 30), std::uint32_t(whole(0, 50)),
                         std::uint32_t(whole(1, 50))},
                        own, c % 4 == 0 ? 0 : in(0, 0.05f));
  }
  for (float& depth : input.surface_m) depth = in(0, 1) < 0.3f ? in(0.3f, 0.6f) : DEPTH_EMPTY;
  for (int i = 0; i < size.particles; ++i) {
    std::vector<ParticlePoint> own;
    const float x = in(0, float(size.width)), y = in(0, float(size.height));
    for (int p = i % 5 == 4 ? 0 : size.points; p > 0; --p)
      own.push_back({x + in(-9, 9), y + in(-9, 9), in(0.3f, 0.6f), std::uint32_t(whole(0, 1))});
    input.add_particle(own);
  }
  input.draw_maps();
  input.draw_combinations(rng, size.combinations, 0.5);
  return input;
}

// A box in front of the camera: a ray cast by hand, edges known to show or not by the way their
// faces look.
struct Box {
  std::array<std::array<double, 3>, 3> axis;  // unit, in the camera's frame
  std::array<double, 3> centre, half;         // metres
};
struct Pinhole {
  double focal, cx, cy;
};

inline double dot(const std::array<double, 3>& a, const std::array<double, 3>& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

inline Box random_box(std::mt19937& rng) {
  std::normal_distribution<double> normal;
  std::uniform_real_distribution<double> unit(-1, 1);
  double q[4], norm = 0;
  for (double& v : q) {
    v = normal(rng);
    norm += v * v;
  }
  for (double& v : q) v /= std::sqrt(norm);
  const double w = q[0], x = q[1], y = q[2], z = q[3];
  return {{{{1 - 2 * (y * y + z * z), 2 * (x * y + w * z), 2 * (x * z - w * y)},
            {2 * (x * y - w * z), 1 - 2 * (x * x + z * z), 2 * (y * z + w * x)},
            {2 * (x * z + w * y), 2 * (y * z - w * x), 1 - 2 * (x * x + y * y)}}},
          {0.05 * unit(rng), 0.04 * unit(rng), 0.4 + 0.05 * unit(rng)},
          {0.03, 0.02, 0.012}};
}

// Depth where the ray of a pixel meets the box; nothing where it misses.
inline std::optional<double> box_depth(const Box& box, const Pinhole& camera, double u, double v) {
  const std::array<double, 3> ray{(u - camera.cx) / camera.focal, (v - camera.cy) / camera.focal,
                                  1};
  double enter = 0, leave = 1e9;
  for (int k = 0; k < 3; ++k) {
    const double along = dot(box.axis[k], ray), at = dot(box.axis[k], box.centre);
    if (along == 0) return std::nullopt;
    const double a = (at - box.half[k]) / along, b = (at + box.half[k]) / along;
    enter = std::max(enter, std::min(a, b));
    leave = std::min(leave, std::max(a, b));
  }
  if (enter > leave) return std::nullopt;
  return enter;
}

// Points along the edges that have a face turned to the camera.
inline std::vector<MapEdge> box_edges(const Box& box, const Pinhole& camera, int points_per_edge) {
  std::vector<MapEdge> edges;
  for (int k = 0; k < 3; ++k)
    for (const double s : {-1.0, 1.0})
      for (const double t : {-1.0, 1.0}) {
        const int a = (k + 1) % 3, b = (k + 2) % 3;
        const auto faces_us = [&](int axis, double sign) {
          return sign * dot(box.axis[axis], box.centre) + box.half[axis] < 0;
        };
        if (!faces_us(a, s) && !faces_us(b, t)) continue;
        for (int i = 0; i <= points_per_edge; ++i) {
          const double along = box.half[k] * (2.0 * i / points_per_edge - 1);
          std::array<double, 3> p;
          for (int r = 0; r < 3; ++r)
            p[r] = box.centre[r] + along * box.axis[k][r] + s * box.half[a] * box.axis[a][r] +
                   t * box.half[b] * box.axis[b][r];
          edges.push_back({float(camera.focal * p[0] / p[2] + camera.cx),
                           float(camera.focal * p[1] / p[2] + camera.cy), float(p[2])});
        }
      }
  return edges;
}

inline void add_box(ChamferInput& input, const Box& box, const Pinhole& camera, int points_per_edge,
                    float tolerance_m) {
  const std::vector<MapEdge> edges = box_edges(box, camera, points_per_edge);
  const auto [left, right] = std::ranges::minmax(edges, {}, &MapEdge::x_px);
  const auto [top, bottom] = std::ranges::minmax(edges, {}, &MapEdge::y_px);
  input.add_candidate(
      map_window(left.x_px, top.y_px, right.x_px, bottom.y_px, input.width, input.height), edges,
      tolerance_m);
  const CandidateMap& map = input.maps.back();
  for (std::size_t i = 0; i < map.window.size(); ++i)
    if (const auto z = box_depth(box, camera, map.window.x0 + int(i % map.window.width),
                                 map.window.y0 + int(i / map.window.width)))
      input.surface_m[map.first_pixel + i] = float(*z);
}

}  // namespace edgescout::test
