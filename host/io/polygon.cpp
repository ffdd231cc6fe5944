#include <Eigen/Geometry>

#include "host/io/raw_mesh.h"
#include "kernels/error.h"

namespace edgescout {

using Eigen::Vector2d;
using Eigen::Vector3d;

namespace {

constexpr int most_corners = 20'000;  // ear clipping takes a time of their number squared

// Newell's normal, which is correct for concave polygons too.
Vector3d polygon_normal(const std::vector<int>& corners, const std::vector<Vector3d>& x) {
  Vector3d normal = Vector3d::Zero();
  const Vector3d& origin = x[corners.front()];
  for (std::size_t i = 1; i + 1 < corners.size(); ++i)
    normal += (x[corners[i]] - origin).cross(x[corners[i + 1]] - origin);
  return normal;
}

double turn(const Vector2d& a, const Vector2d& b, const Vector2d& c) {
  const Vector2d ab = b - a, ac = c - a;
  return ab.x() * ac.y() - ab.y() * ac.x();
}

// Returns whether corner i of the remaining polygon can be cut off: it is convex, and no other
// corner lies in its triangle.
bool is_ear(const std::vector<int>& rest, std::size_t i, const std::vector<Vector2d>& flat) {
  const std::size_t n = rest.size(), before = (i + n - 1) % n, after = (i + 1) % n;
  const Vector2d &a = flat[rest[before]], &b = flat[rest[i]], &c = flat[rest[after]];
  if (turn(a, b, c) <= 0) return false;
  for (std::size_t k = 0; k < n; ++k) {
    const Vector2d& p = flat[rest[k]];
    if (k == before || k == i || k == after || p == a || p == b || p == c) continue;
    if (turn(a, b, p) >= 0 && turn(b, c, p) >= 0 && turn(c, a, p) >= 0) return false;
  }
  return true;
}

}  // namespace

void triangulate(const std::vector<int>& corners, const std::vector<Vector3d>& vertices,
                 std::vector<std::array<int, 3>>& triangles) {
  if (corners.size() < 3) return;
  if (corners.size() == 3) return triangles.push_back({corners[0], corners[1], corners[2]});
  const Vector3d normal = polygon_normal(corners, vertices).normalized();
  const Vector3d u = normal.unitOrthogonal(), v = normal.cross(u);
  std::vector<Vector2d> flat;
  std::vector<int> rest;
  for (int corner : corners) {
    rest.push_back(static_cast<int>(flat.size()));
    flat.emplace_back(vertices[corner].dot(u), vertices[corner].dot(v));
  }
  while (rest.size() > 3) {
    std::size_t ear = 0;
    while (ear < rest.size() && !is_ear(rest, ear, flat)) ++ear;
    if (ear == rest.size()) break;
    const std::size_t n = rest.size();
    triangles.push_back(
        {corners[rest[(ear + n - 1) % n]], corners[rest[ear]], corners[rest[(ear + 1) % n]]});
    rest.erase(rest.begin() + static_cast<std::ptrdiff_t>(ear));
  }
  for (std::size_t i = 1; i + 1 < rest.size(); ++i)
    triangles.push_back({corners[rest[0]], corners[rest[i]], corners[rest[i + 1]]});
}

void add_polygons(std::span<const int> counted_corners, int first_index, const std::string& source,
                  RawMesh& mesh) {
  const int count = static_cast<int>(mesh.vertices.size());
  std::vector<int> corners;
  for (int face = 0; !counted_corners.empty(); ++face) {
    const int size = counted_corners.front();
    const auto fail = [&](const std::string& found, const std::string& expected) {
      throw InputError(source, "face " + std::to_string(face + first_index), found, expected);
    };
    if (size > most_corners)
      fail(std::to_string(size) + " corners", "at most " + std::to_string(most_corners));
    corners.clear();
    for (const int index : counted_corners.subspan(1, static_cast<std::size_t>(size))) {
      if (index < first_index || index - first_index >= count)
        fail("vertex index " + std::to_string(index),
             "an index below " + std::to_string(count + first_index));
      corners.push_back(index - first_index);
    }
    triangulate(corners, mesh.vertices, mesh.triangles);
    counted_corners = counted_corners.subspan(1 + static_cast<std::size_t>(size));
  }
}

}  // namespace edgescout
