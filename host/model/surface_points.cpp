#include "host/model/surface_points.h"

#include <algorithm>
#include <cmath>

namespace edgescout {

namespace {

// The van der Corput sequence: its every beginning is spread evenly over [0, 1).
double radical_inverse(std::uint32_t i, std::uint32_t base) {
  double value = 0, digit = 1.0 / base;
  for (; i > 0; i /= base, digit /= base) value += digit * (i % base);
  return value;
}

SurfacePoint point_of(const Eigen::Vector3d& point_m, const Eigen::Vector3d& normal) {
  return {float(point_m.x()), float(point_m.y()), float(point_m.z()),
          float(normal.x()),  float(normal.y()),  float(normal.z())};
}

// The sums of the areas up to and with each triangle, m^2.
std::vector<double> areas_so_far_m2(const Mesh& mesh) {
  std::vector<double> sums;
  double sum = 0;
  for (const auto& [a, b, c] : mesh.triangles) {
    const Eigen::Vector3d& corner = mesh.vertices_m[std::size_t(a)];
    sum += 0.5 * (mesh.vertices_m[std::size_t(b)] - corner)
                     .cross(mesh.vertices_m[std::size_t(c)] - corner)
                     .norm();
    sums.push_back(sum);
  }
  return sums;
}

// Uniform in the triangle for uniform s and t (Turk, Graphics Gems 1990).
Eigen::Vector3d point_in(const Mesh& mesh, const std::array<int, 3>& corners, double s, double t) {
  const double root = std::sqrt(s);
  return (1 - root) * mesh.vertices_m[std::size_t(corners[0])] +
         root * (1 - t) * mesh.vertices_m[std::size_t(corners[1])] +
         root * t * mesh.vertices_m[std::size_t(corners[2])];
}

}  // namespace

std::vector<SurfacePoint> sample_surface(const Mesh& mesh, bool has_open_borders, int count) {
  const std::vector<double> sums = areas_so_far_m2(mesh);
  std::vector<SurfacePoint> points;
  if (sums.empty() || !(sums.back() > 0)) return points;
  for (int i = 1; i <= count; ++i) {
    const auto number = std::uint32_t(i);
    const auto chosen = std::ranges::upper_bound(sums, sums.back() * radical_inverse(number, 2));
    const auto triangle = std::size_t(std::min(chosen - sums.begin(), std::ssize(sums) - 1));
    const Eigen::Vector3d point_m = point_in(
        mesh, mesh.triangles[triangle], radical_inverse(number, 3), radical_inverse(number, 5));
    points.push_back(point_of(point_m, mesh.face_normals[triangle]));
    if (has_open_borders) points.push_back(point_of(point_m, -mesh.face_normals[triangle]));
  }
  return points;
}

}  // namespace edgescout
