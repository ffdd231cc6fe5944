#include "host/render/parts.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "host/render/solid.h"
#include "kernels/error.h"

namespace edgescout {
namespace {

constexpr double PI = std::numbers::pi;

Se3 turn(const Eigen::Vector3d& axis, double angle_rad) {
  return {so3_exp(angle_rad * axis), Eigen::Vector3d::Zero()};
}

// `steps` turns about z. If the part also looks the same upside down, each turn once more with a
// half turn about x.
Symmetries turns_about_z(int steps, bool turns_over) {
  Symmetries symmetries;
  symmetries.discrete.clear();
  for (int flip = 0; flip <= (turns_over ? 1 : 0); ++flip)
    for (int i = 0; i < steps; ++i)
      symmetries.discrete.push_back(turn(Eigen::Vector3d::UnitZ(), 2 * PI * i / steps) *
                                    turn(Eigen::Vector3d::UnitX(), flip * PI));
  return symmetries;
}

Symmetries half_turn(const Eigen::Vector3d& axis) { return {{Se3{}, turn(axis, PI)}}; }

// Two legs of different length; two holes in the long one, one in the short one. No symmetry.
Object l_bracket() {
  Extrusion e;
  e.outline_mm = {{0, 0}, {56, 0}, {56, 5}, {5, 5}, {5, 38}, {0, 38}};
  e.height_mm = 32;
  e.cross_holes = {{0, 2, 20, 9, 3.5}, {0, 2, 44, 22, 3.5}, {3, 5, 16, 16, 6}};
  return {1, extrude("l_bracket", e), {}};
}

// A pillow block: a foot with two bolt holes and a round head with a bore.
Object bearing_block() {
  Extrusion e;
  e.outline_mm = {{0, 0}, {76, 0}, {76, 10}, {57, 10}};
  for (int i = 0; i <= 16; ++i) {
    const double angle = PI * i / 16;
    e.outline_mm.emplace_back(38 + 19 * std::cos(angle), 28 + 19 * std::sin(angle));
  }
  e.outline_mm.insert(e.outline_mm.end(), {{19, 10}, {0, 10}});
  e.holes_mm = {circle({38, 28}, 11, true, 36)};
  e.height_mm = 22;
  const int left = static_cast<int>(e.outline_mm.size()) - 2;
  e.cross_holes = {{0, 2, 66.5, 11, 3.5}, {0, left, 9.5, 11, 3.5}};
  return {2, extrude("bearing_block", e), half_turn(Eigen::Vector3d::UnitY())};
}

Object stepped_shaft() {
  const Loop2d profile{{4, 0},   {11, 0},  {12, 1}, {12, 18}, {20, 18}, {20, 26},
                       {14, 26}, {14, 48}, {9, 48}, {9, 69},  {8, 70},  {4, 70}};
  return {3, revolve("stepped_shaft", profile), turns_about_z(64, false)};
}

Object hex_nut() {
  Extrusion e;
  e.outline_mm = circle({0, 0}, 23, false, 6);
  e.holes_mm = {circle({0, 0}, 12, true, 36)};
  e.height_mm = 18;
  return {4, extrude("hex_nut", e), turns_about_z(6, true)};
}

// A channel with a large hole in its web and two small ones in each flange.
Object u_channel() {
  Extrusion e;
  e.outline_mm = {{0, 0}, {36, 0}, {36, 26}, {32, 26}, {32, 4}, {4, 4}, {4, 26}, {0, 26}};
  e.height_mm = 64;
  e.cross_holes = {{0, 4, 18, 32, 8},
                   {1, 3, 16, 14, 4},
                   {1, 3, 16, 50, 4},
                   {5, 7, 12, 14, 4},
                   {5, 7, 12, 50, 4}};
  return {5, extrude("u_channel", e), half_turn(Eigen::Vector3d::UnitY())};
}

// Twelve trapezoid teeth, a bore and three lightening holes.
Object gear_plate() {
  Extrusion e;
  constexpr int TEETH = 12;
  for (int i = 0; i < TEETH; ++i)
    for (const auto& [radius, share] :
         {std::pair{24.0, -0.27}, {30.0, -0.15}, {30.0, 0.15}, {24.0, 0.27}}) {
      const double angle = 2 * PI * (i + share) / TEETH;
      e.outline_mm.emplace_back(radius * std::cos(angle), radius * std::sin(angle));
    }
  e.holes_mm = {circle({0, 0}, 6, true, 30)};
  for (int i = 0; i < 3; ++i)
    e.holes_mm.push_back(circle(
        15 * Eigen::Vector2d(std::cos(2 * PI * i / 3), std::sin(2 * PI * i / 3)), 5, true, 24));
  e.height_mm = 9;
  return {6, extrude("gear_plate", e), turns_about_z(3, true)};
}

using Maker = Object (*)();
constexpr std::pair<const char*, Maker> PARTS[] = {
    {"l_bracket", l_bracket}, {"bearing_block", bearing_block}, {"stepped_shaft", stepped_shaft},
    {"hex_nut", hex_nut},     {"u_channel", u_channel},         {"gear_plate", gear_plate}};

}  // namespace

std::vector<std::string> part_names() {
  std::vector<std::string> names;
  for (const auto& [name, maker] : PARTS) names.emplace_back(name);
  return names;
}

Object make_part(const std::string& name) {
  std::string known;
  for (const auto& [part, maker] : PARTS) {
    if (name == part) return maker();
    known += (known.empty() ? "" : ", ") + std::string(part);
  }
  throw InputError("command line", "part", name, "one of " + known);
}

std::map<int, Eigen::Vector3d> turning_axes(std::span<const Object> parts) {
  std::map<int, Eigen::Vector3d> axes;
  for (const Object& part : parts)
    if (part.mesh.name == "stepped_shaft") axes[part.id] = Eigen::Vector3d::UnitZ();
  return axes;
}

Mesh make_box(const Eigen::Vector3d& size_m) {
  const Eigen::Vector3d s = 1e3 * size_m;
  return extrude("box", {{{0, 0}, {s.x(), 0}, {s.x(), s.y()}, {0, s.y()}}, {}, {}, s.z()});
}

Mesh make_bar(double radius_m, double length_m) {
  const double r = 1e3 * radius_m, l = 1e3 * length_m;
  return revolve("bar", {{0, 0}, {r, 0}, {r, l}, {0, l}});
}

Mesh make_ring(double outer_radius_m, double inner_radius_m, double height_m) {
  const double outer = 1e3 * outer_radius_m, inner = 1e3 * inner_radius_m, h = 1e3 * height_m;
  return revolve("ring", {{inner, 0}, {outer, 0}, {outer, h}, {inner, h}});
}

}  // namespace edgescout
