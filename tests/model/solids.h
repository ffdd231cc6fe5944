// Solids whose edges are known in closed form.
#pragma once

#include <cmath>
#include <map>
#include <vector>

#include "host/io/mesh.h"
#include "host/model/edge_model.h"

namespace edgescout::test {

// Twenty triangles, each divided into four `levels` times, with corners on the sphere.
inline Mesh icosphere(double radius_m, int levels) {
  const double g = (1 + std::sqrt(5.0)) / 2;
  std::vector<Eigen::Vector3d> v{{-1, g, 0}, {1, g, 0}, {-1, -g, 0}, {1, -g, 0},
                                 {0, -1, g}, {0, 1, g}, {0, -1, -g}, {0, 1, -g},
                                 {g, 0, -1}, {g, 0, 1}, {-g, 0, -1}, {-g, 0, 1}};
  std::vector<std::array<int, 3>> t{{0, 11, 5}, {0, 5, 1},  {0, 1, 7},   {0, 7, 10}, {0, 10, 11},
                                    {1, 5, 9},  {5, 11, 4}, {11, 10, 2}, {10, 7, 6}, {7, 1, 8},
                                    {3, 9, 4},  {3, 4, 2},  {3, 2, 6},   {3, 6, 8},  {3, 8, 9},
                                    {4, 9, 5},  {2, 4, 11}, {6, 2, 10},  {8, 6, 7},  {9, 8, 1}};
  for (int level = 0; level < levels; ++level) {
    std::map<std::pair<int, int>, int> middles;
    const auto middle = [&](int a, int b) {
      const auto [it, fresh] = middles.try_emplace(std::minmax(a, b), int(v.size()));
      if (fresh) v.push_back(v[a] + v[b]);
      return it->second;
    };
    for (Eigen::Vector3d& corner : v) corner.normalize();
    std::vector<std::array<int, 3>> finer;
    for (const auto& [a, b, c] : t) {
      const int ab = middle(a, b), bc = middle(b, c), ca = middle(c, a);
      finer.insert(finer.end(), {{a, ab, ca}, {b, bc, ab}, {c, ca, bc}, {ab, bc, ca}});
    }
    t = std::move(finer);
  }
  for (Eigen::Vector3d& corner : v) corner = radius_m * corner.normalized();
  return make_mesh("icosphere", v, t);
}

inline EdgeModel model_of(const Mesh& mesh, double raster_step_m) {
  EdgeModelOptions options;
  options.raster_step_m = raster_step_m;
  return make_edge_model(mesh, options);
}

}  // namespace edgescout::test
