// Spoils meshes as CAD exports, converters and scans do.
#pragma once

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <map>
#include <random>
#include <utility>
#include <vector>

#include "host/core/types.h"

namespace edgescout::test {

struct Triangles {
  std::vector<Eigen::Vector3d> vertices;
  std::vector<std::array<int, 3>> triangles;
};

inline Triangles triangles_of(const Mesh& mesh) { return {mesh.vertices_m, mesh.triangles}; }

// Every triangle with vertices of its own.
inline Triangles loose(const Triangles& mesh) {
  Triangles result;
  for (const auto& triangle : mesh.triangles) {
    const int first = int(result.vertices.size());
    for (const int v : triangle) result.vertices.push_back(mesh.vertices[v]);
    result.triangles.push_back({first, first + 1, first + 2});
  }
  return result;
}

// Moves every vertex by up to the amplitude along each axis.
inline Triangles jittered(Triangles mesh, double amplitude_m, unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> by(-amplitude_m, amplitude_m);
  for (Eigen::Vector3d& x : mesh.vertices) x += Eigen::Vector3d(by(random), by(random), by(random));
  return mesh;
}

// Turns each triangle over with the given probability.
inline Triangles flipped(Triangles mesh, double probability, unsigned seed) {
  std::mt19937 random(seed);
  std::bernoulli_distribution turns(probability);
  for (auto& triangle : mesh.triangles)
    if (turns(random)) std::swap(triangle[1], triangle[2]);
  return mesh;
}

// Divides one random side of each triangle with the given probability, but not the triangle on the
// other side of it.
inline Triangles with_t_junctions(const Triangles& mesh, double probability, unsigned seed) {
  std::mt19937 random(seed);
  std::bernoulli_distribution divides(probability);
  std::uniform_int_distribution<std::size_t> side(0, 2);
  std::uniform_real_distribution<double> place(0.2, 0.8);
  Triangles result{mesh.vertices, {}};
  for (const auto& triangle : mesh.triangles) {
    if (!divides(random)) {
      result.triangles.push_back(triangle);
      continue;
    }
    const std::size_t s = side(random);
    const int a = triangle[s], b = triangle[(s + 1) % 3], c = triangle[(s + 2) % 3],
              middle = int(result.vertices.size());
    const double t = place(random);
    result.vertices.push_back((1 - t) * mesh.vertices[a] + t * mesh.vertices[b]);
    result.triangles.push_back({a, middle, c});
    result.triangles.push_back({middle, b, c});
  }
  return result;
}

// Every triangle again, turned over.
inline Triangles doubled(Triangles mesh) {
  const std::size_t count = mesh.triangles.size();
  for (std::size_t t = 0; t < count; ++t) {
    auto again = mesh.triangles[t];
    std::swap(again[1], again[2]);
    mesh.triangles.push_back(again);
  }
  return mesh;
}

// Puts a triangle of nearly no height on every third side: its corners are the side's ends and a
// point `height_m` off the middle, in the direction of the third corner. The triangle of the side
// is divided there, so the surface stays closed.
inline Triangles with_slivers(const Triangles& mesh, double height_m) {
  Triangles result{mesh.vertices, {}};
  std::map<std::pair<int, int>, int> divided;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    const auto& [a, b, c] = mesh.triangles[t];
    if (t % 3 != 0 || !divided.emplace(std::minmax(a, b), int(t)).second) {
      result.triangles.push_back(mesh.triangles[t]);
      continue;
    }
    const Eigen::Vector3d middle = 0.5 * (mesh.vertices[a] + mesh.vertices[b]);
    const int m = int(result.vertices.size());
    result.vertices.push_back(middle + height_m * (mesh.vertices[c] - middle).normalized());
    result.triangles.insert(result.triangles.end(), {{a, m, c}, {m, b, c}, {a, b, m}});
  }
  return result;
}

// A bar along z of which the wall and the two ends are tessellated apart: the rims have other
// vertices on each side, and the chords leave gaps of up to the sag.
inline Triangles bar_with_cracks(double radius_m, double length_m, int wall_corners,
                                 int end_corners) {
  Triangles bar;
  const auto ring = [&](int corners, double z_m, double turn) {
    const int first = int(bar.vertices.size());
    for (int i = 0; i < corners; ++i) {
      const double angle = 2 * M_PI * i / corners + turn;
      bar.vertices.push_back({radius_m * std::cos(angle), radius_m * std::sin(angle), z_m});
    }
    return first;
  };
  const int low = ring(wall_corners, 0, 0), high = ring(wall_corners, length_m, 0);
  for (int i = 0; i < wall_corners; ++i) {
    const int next = (i + 1) % wall_corners;
    bar.triangles.push_back({low + i, low + next, high + next});
    bar.triangles.push_back({low + i, high + next, high + i});
  }
  const int bottom = ring(end_corners, 0, 0.1), top = ring(end_corners, length_m, 0.2);
  for (int i = 1; i + 1 < end_corners; ++i) {
    bar.triangles.push_back({bottom, bottom + i + 1, bottom + i});
    bar.triangles.push_back({top, top + i, top + i + 1});
  }
  return bar;
}

}  // namespace edgescout::test
