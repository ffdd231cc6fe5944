#include "host/render/solid.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "host/io/mesh.h"
#include "kernels/error.h"

namespace edgescout {
namespace {

using Loop3d = std::vector<Eigen::Vector3d>;

struct Shell {
  std::vector<Eigen::Vector3d> vertices_mm;
  std::vector<std::array<int, 3>> triangles;

  void add(const Eigen::Vector3d& a, const Eigen::Vector3d& b, const Eigen::Vector3d& c) {
    const int first = static_cast<int>(vertices_mm.size());
    vertices_mm.insert(vertices_mm.end(), {a, b, c});
    triangles.push_back({first, first + 1, first + 2});
  }
};

// A plane face. `x` and `y` span it; x cross y points outwards.
void add_face(Shell& shell, const Eigen::Vector3d& x, const Eigen::Vector3d& y,
              const Loop3d& outline, const std::vector<Loop3d>& holes) {
  const auto flat = [&](const Loop3d& loop) {
    Loop2d out;
    for (const Eigen::Vector3d& p : loop) out.emplace_back(x.dot(p), y.dot(p));
    return out;
  };
  Loop3d corners = outline;
  std::vector<Loop2d> flat_holes;
  for (const Loop3d& hole : holes) {
    corners.insert(corners.end(), hole.begin(), hole.end());
    flat_holes.push_back(flat(hole));
  }
  for (const auto& [a, b, c] : triangulate(flat(outline), flat_holes))
    shell.add(corners[a], corners[b], corners[c]);
}

// Adds the wall between two loops of equal length. Seen from outside, `bottom` goes to the right
// and `top` lies above it.
void add_wall(Shell& shell, const Loop3d& bottom, const Loop3d& top) {
  for (std::size_t i = 0; i < bottom.size(); ++i) {
    const std::size_t j = (i + 1) % bottom.size();
    shell.add(bottom[i], bottom[j], top[j]);
    shell.add(bottom[i], top[j], top[i]);
  }
}

Loop3d lift(const Loop2d& loop, double z) {
  Loop3d out;
  for (const Eigen::Vector2d& p : loop) out.emplace_back(p.x(), p.y(), z);
  return out;
}

Loop3d reversed(Loop3d loop) {
  std::reverse(loop.begin(), loop.end());
  return loop;
}

void add_caps(Shell& shell, const Extrusion& e) {
  std::vector<Loop3d> top, bottom;
  for (const Loop2d& hole : e.holes_mm) {
    top.push_back(lift(hole, e.height_mm));
    bottom.push_back(reversed(lift(hole, 0)));
    add_wall(shell, lift(hole, 0), lift(hole, e.height_mm));
  }
  const Eigen::Vector3d x = Eigen::Vector3d::UnitX(), y = Eigen::Vector3d::UnitY();
  add_face(shell, x, y, lift(e.outline_mm, e.height_mm), top);
  add_face(shell, y, x, reversed(lift(e.outline_mm, 0)), bottom);
}

struct Side {
  Eigen::Vector2d from, to, along;  // along: unit
  Eigen::Vector2d normal() const { return {along.y(), -along.x()}; }
};

Side side_of(const Loop2d& outline, int index) {
  const Eigen::Vector2d &from = outline[index], &to = outline[(index + 1) % outline.size()];
  return {from, to, (to - from).normalized()};
}

// The hole's rim on its first side, clockwise seen from outside that side, and the same points on
// the other side.
std::pair<Loop3d, Loop3d> rims(const Extrusion& e, const CrossHole& hole) {
  const Side from = side_of(e.outline_mm, hole.from_side), to = side_of(e.outline_mm, hole.to_side);
  check(from.along.dot(to.along) < -1 + 1e-9,
        "extrude: a cross hole needs two parallel sides that face apart");
  const double depth = (from.from - to.from).dot(from.normal());
  Loop3d near, far;
  for (const Eigen::Vector2d& p :
       circle({hole.along_mm, hole.height_mm}, hole.radius_mm, true, 24)) {
    const Eigen::Vector2d on_side = from.from + p.x() * from.along;
    const Eigen::Vector2d opposite = on_side - depth * from.normal();
    near.emplace_back(on_side.x(), on_side.y(), p.y());
    far.emplace_back(opposite.x(), opposite.y(), p.y());
  }
  return {near, far};
}

void add_sides(Shell& shell, const Extrusion& e) {
  std::vector<std::vector<Loop3d>> holes(e.outline_mm.size());
  for (const CrossHole& hole : e.cross_holes) {
    const auto [near, far] = rims(e, hole);
    holes[hole.from_side].push_back(near);
    holes[hole.to_side].push_back(reversed(far));
    add_wall(shell, far, near);
  }
  for (std::size_t i = 0; i < e.outline_mm.size(); ++i) {
    const Side side = side_of(e.outline_mm, static_cast<int>(i));
    const Loop2d ends{side.from, side.to};
    const Loop3d low = lift(ends, 0), high = lift(ends, e.height_mm);
    add_face(shell, {side.along.x(), side.along.y(), 0}, Eigen::Vector3d::UnitZ(),
             {low[0], low[1], high[1], high[0]}, holes[i]);
  }
}

Mesh finish(const std::string& name, Shell shell) {
  Eigen::Vector3d low = shell.vertices_mm.front(), high = low;
  for (const Eigen::Vector3d& v : shell.vertices_mm) {
    low = low.cwiseMin(v);
    high = high.cwiseMax(v);
  }
  for (Eigen::Vector3d& v : shell.vertices_mm) v = 1e-3 * (v - 0.5 * (low + high));
  return make_mesh(name, std::move(shell.vertices_mm), std::move(shell.triangles));
}

}  // namespace

Loop2d circle(const Eigen::Vector2d& centre_mm, double radius_mm, bool clockwise, int corners) {
  Loop2d loop;
  for (int i = 0; i < corners; ++i) {
    const double angle = 2 * std::numbers::pi * (clockwise ? -i : i) / corners;
    loop.push_back(centre_mm + radius_mm * Eigen::Vector2d(std::cos(angle), std::sin(angle)));
  }
  return loop;
}

Mesh extrude(const std::string& name, const Extrusion& extrusion) {
  check(extrusion.height_mm > 0, "extrude: the height must be positive");
  Shell shell;
  add_caps(shell, extrusion);
  add_sides(shell, extrusion);
  return finish(name, std::move(shell));
}

Mesh revolve(const std::string& name, const Loop2d& profile_mm, int segments) {
  check(profile_mm.size() >= 3 && signed_area(profile_mm) > 0,
        "revolve: the profile must run counter-clockwise");
  const auto at = [&](const Eigen::Vector2d& p, int s) {
    const double angle = 2 * std::numbers::pi * (s % segments) / segments;
    return Eigen::Vector3d(p.x() * std::cos(angle), p.x() * std::sin(angle), p.y());
  };
  Shell shell;
  for (std::size_t i = 0; i < profile_mm.size(); ++i) {
    const Eigen::Vector2d &a = profile_mm[i], &b = profile_mm[(i + 1) % profile_mm.size()];
    check(a.x() >= 0, "revolve: the profile must not cross the axis");
    for (int s = 0; s < segments; ++s) {
      if (a.x() > 0) shell.add(at(a, s), at(a, s + 1), at(b, s));
      if (b.x() > 0) shell.add(at(a, s + 1), at(b, s + 1), at(b, s));
    }
  }
  return finish(name, std::move(shell));
}

double enclosed_volume_m3(const Mesh& mesh) {
  double six_times = 0;
  for (const auto& [a, b, c] : mesh.triangles)
    six_times += mesh.vertices_m[a].dot(mesh.vertices_m[b].cross(mesh.vertices_m[c]));
  return six_times / 6;
}

}  // namespace edgescout
