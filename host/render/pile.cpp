#include "host/render/pile.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "kernels/error.h"

namespace edgescout {
namespace {

double support(const std::vector<Eigen::Vector3d>& points, const Eigen::Vector3d& direction) {
  double highest = -std::numeric_limits<double>::infinity();
  for (const Eigen::Vector3d& p : points) highest = std::max(highest, p.dot(direction));
  return highest;
}

// Vertices relative to the centre of mass. Only vertices that are extreme in one of many directions
// are kept: no other vertex can touch the plane.
std::vector<Eigen::Vector3d> extreme_points(const Mesh& mesh, const Eigen::Vector3d& centre) {
  constexpr int DIRECTIONS = 1000;
  if (mesh.vertices_m.size() <= DIRECTIONS / 2) {
    std::vector<Eigen::Vector3d> all;
    for (const Eigen::Vector3d& v : mesh.vertices_m) all.push_back(v - centre);
    return all;
  }
  std::vector<char> taken(mesh.vertices_m.size(), 0);
  std::vector<Eigen::Vector3d> points;
  Random random(DIRECTIONS);
  for (int i = 0; i < DIRECTIONS; ++i) {
    const Eigen::Vector3d direction = random.direction();
    const auto further = [&](const Eigen::Vector3d& a, const Eigen::Vector3d& b) {
      return a.dot(direction) < b.dot(direction);
    };
    const auto best = std::max_element(mesh.vertices_m.begin(), mesh.vertices_m.end(), further) -
                      mesh.vertices_m.begin();
    if (taken[best]) continue;
    taken[best] = 1;
    points.push_back(mesh.vertices_m[best] - centre);
  }
  return points;
}

}  // namespace

Eigen::Vector3d surface_centre(const Mesh& mesh) {
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  double area = 0;
  for (const auto& [ia, ib, ic] : mesh.triangles) {
    const Eigen::Vector3d &a = mesh.vertices_m[ia], &b = mesh.vertices_m[ib],
                          &c = mesh.vertices_m[ic];
    const double weight = (b - a).cross(c - a).norm();
    sum += weight * (a + b + c) / 3;
    area += weight;
  }
  check(area > 0, "surface_centre: the mesh has no area");
  return sum / area;
}

Eigen::Quaterniond random_rest(const Mesh& mesh, Random& random) {
  const std::vector<Eigen::Vector3d> points = extreme_points(mesh, surface_centre(mesh));
  // The part rests at the minima of the centre's height over the plane, as a function of the
  // direction that points down. The search descends from a random start.
  Eigen::Vector3d down = random.direction();
  double height = support(points, down);
  for (double step = 0.3; step > 1e-5;) {
    const Eigen::Vector3d trial = (down + step * random.direction()).normalized();
    const double trial_height = support(points, trial);
    const bool better = trial_height < height;
    step *= better ? 1.3 : 0.93;
    step = std::min(step, 0.3);
    if (!better) continue;
    down = trial;
    height = trial_height;
  }
  const Eigen::AngleAxisd yaw(random.uniform(0, 2 * std::numbers::pi), Eigen::Vector3d::UnitZ());
  return (yaw * Eigen::Quaterniond::FromTwoVectors(down, -Eigen::Vector3d::UnitZ())).normalized();
}

// Lowest and highest surface over each cell in a window of the table, relative to the object's
// origin.
struct PileTable::Footprint {
  int x0 = 0, y0 = 0, width = 0, height = 0;
  std::vector<float> low_m, high_m;

  void touch(int x, int y, double z) {
    if (x < x0 || y < y0 || x >= x0 + width || y >= y0 + height) return;
    const std::size_t i = static_cast<std::size_t>(y - y0) * width + (x - x0);
    low_m[i] = std::min(low_m[i], static_cast<float>(z));
    high_m[i] = std::max(high_m[i], static_cast<float>(z));
  }
};

PileTable::PileTable(double side_m, double cell_m)
    : cells_(static_cast<int>(std::ceil(side_m / cell_m))),
      cell_m_(cell_m),
      heights_m_(static_cast<std::size_t>(cells_) * cells_, 0.0f) {}

namespace {

// Calls touch(x, y, z) for every integer (x, y) whose point lies in the triangle.
template <typename Touch>
void scan_triangle(const Eigen::Vector3d& a, const Eigen::Vector3d& b, const Eigen::Vector3d& c,
                   const Touch& touch) {
  const double area = (b.x() - a.x()) * (c.y() - a.y()) - (b.y() - a.y()) * (c.x() - a.x());
  if (std::abs(area) < 1e-12) return;
  const auto [x_low, x_high] = std::minmax({a.x(), b.x(), c.x()});
  const auto [y_low, y_high] = std::minmax({a.y(), b.y(), c.y()});
  for (int y = static_cast<int>(std::ceil(y_low)); y <= y_high; ++y)
    for (int x = static_cast<int>(std::ceil(x_low)); x <= x_high; ++x) {
      const double v = ((x - a.x()) * (c.y() - a.y()) - (y - a.y()) * (c.x() - a.x())) / area;
      const double w = ((b.x() - a.x()) * (y - a.y()) - (b.y() - a.y()) * (x - a.x())) / area;
      if (v >= 0 && w >= 0 && v + w <= 1)
        touch(x, y, a.z() + v * (b.z() - a.z()) + w * (c.z() - a.z()));
    }
}

}  // namespace

PileTable::Footprint PileTable::footprint(const Mesh& mesh, const Eigen::Quaterniond& rotation,
                                          const Eigen::Vector2d& at) const {
  const Eigen::Matrix3d turned = rotation.toRotationMatrix();
  std::vector<Eigen::Vector3d> vertices;  // x and y in cells, z in metres
  Eigen::Vector2d low = Eigen::Vector2d::Constant(1e9), high = -low;
  for (const Eigen::Vector3d& v : mesh.vertices_m) {
    Eigen::Vector3d p = turned * v;
    p.head<2>() = (p.head<2>() + at) / cell_m_ + Eigen::Vector2d::Constant(0.5 * cells_);
    low = low.cwiseMin(p.head<2>());
    high = high.cwiseMax(p.head<2>());
    vertices.push_back(p);
  }
  Footprint f;
  f.x0 = static_cast<int>(std::floor(low.x()));
  f.y0 = static_cast<int>(std::floor(low.y()));
  f.width = static_cast<int>(std::ceil(high.x())) - f.x0 + 1;
  f.height = static_cast<int>(std::ceil(high.y())) - f.y0 + 1;
  const std::size_t size = static_cast<std::size_t>(f.width) * f.height;
  f.low_m.assign(size, std::numeric_limits<float>::infinity());
  f.high_m.assign(size, -std::numeric_limits<float>::infinity());
  for (const Eigen::Vector3d& v : vertices)
    f.touch(static_cast<int>(std::lround(v.x())), static_cast<int>(std::lround(v.y())), v.z());
  for (const auto& [a, b, c] : mesh.triangles)
    scan_triangle(vertices[a], vertices[b], vertices[c],
                  [&](int x, int y, double z) { f.touch(x, y, z); });
  return f;
}

double PileTable::rest_height(const Footprint& f) const {
  double height = -std::numeric_limits<double>::infinity();
  for (int y = 0; y < f.height; ++y)
    for (int x = 0; x < f.width; ++x) {
      const int column = f.x0 + x, row = f.y0 + y;
      const bool on_table = column >= 0 && row >= 0 && column < cells_ && row < cells_;
      const float under =
          on_table ? heights_m_[static_cast<std::size_t>(row) * cells_ + column] : 0.0f;
      height = std::max<double>(height, under - f.low_m[static_cast<std::size_t>(y) * f.width + x]);
    }
  return height;
}

void PileTable::occupy(const Footprint& f, double height_m) {
  // One cell wider than the part, since the surface between cell centres is not sampled.
  for (int y = -1; y <= f.height; ++y)
    for (int x = -1; x <= f.width; ++x) {
      const int column = f.x0 + x, row = f.y0 + y;
      if (column < 0 || row < 0 || column >= cells_ || row >= cells_) continue;
      float& cell = heights_m_[static_cast<std::size_t>(row) * cells_ + column];
      for (int v = std::max(0, y - 1); v <= std::min(f.height - 1, y + 1); ++v)
        for (int u = std::max(0, x - 1); u <= std::min(f.width - 1, x + 1); ++u)
          cell = std::max(cell, f.high_m[static_cast<std::size_t>(v) * f.width + u] +
                                    static_cast<float>(height_m));
    }
}

Se3 PileTable::slide_downhill(const Mesh& mesh, Se3 pose, double radius_m, Random& random) const {
  constexpr int TRIALS = 150;
  const Eigen::Vector3d centre = surface_centre(mesh);
  const auto energy = [&](const Se3& at) { return (at * centre).z(); };
  for (int trial = 0; trial < TRIALS; ++trial) {
    const double scale = std::pow(0.97, trial);
    Se3 moved = pose;
    const Eigen::Vector3d turn_axis = random.direction();
    moved.rotation =
        (so3_exp(0.25 * scale * random.uniform() * turn_axis) * pose.rotation).normalized();
    for (int axis = 0; axis < 2; ++axis)
      moved.translation_m[axis] += 0.08 * scale * mesh.diameter_m * random.normal();
    if (moved.translation_m.head<2>().norm() > radius_m) continue;
    moved.translation_m.z() =
        rest_height(footprint(mesh, moved.rotation, moved.translation_m.head<2>()));
    if (energy(moved) < energy(pose)) pose = moved;
  }
  return pose;
}

Se3 PileTable::place(const Mesh& mesh, double radius_m, bool alone, Random& random) {
  constexpr int TRIALS = 200;
  Se3 pose;
  pose.rotation = random_rest(mesh, random);
  double bare_height = 0, reach = radius_m;
  for (const Eigen::Vector3d& v : mesh.vertices_m)
    bare_height = std::max(bare_height, -(pose.rotation * v).z());
  for (int trial = 0; trial < TRIALS; ++trial) {
    const double angle = random.uniform(0, 2 * std::numbers::pi),
                 r = reach * std::sqrt(random.uniform());
    pose.translation_m.head<2>() = Eigen::Vector2d(r * std::cos(angle), r * std::sin(angle));
    pose.translation_m.z() =
        rest_height(footprint(mesh, pose.rotation, pose.translation_m.head<2>()));
    const bool bare = pose.translation_m.z() < bare_height + 1e-6;
    if (bare || !alone) break;
    reach *= 1.01;
  }
  if (pose.translation_m.z() > bare_height + 1e-6) pose = slide_downhill(mesh, pose, reach, random);
  occupy(footprint(mesh, pose.rotation, pose.translation_m.head<2>()), pose.translation_m.z());
  return pose;
}

}  // namespace edgescout
