#include "host/render/room.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace edgescout {
namespace {

enum RoomSide { EAST, NORTH, WEST, SOUTH, CEILING };

// A rectangle on one side of the room. Walls: x along the wall, y up; m.
struct Panel {
  int side = CEILING;
  Eigen::Vector2d low, high;
  double light = 0;
  bool covers(const Eigen::Vector2d& p) const {
    return (p.array() > low.array()).all() && (p.array() < high.array()).all();
  }
};

// The eye is at the origin, on the table.
struct Room {
  std::array<double, 5> distance_m;  // to each side
  std::array<double, 5> light;       // of each side
  std::vector<Panel> panels;         // a later one covers an earlier one

  double seen(const Eigen::Vector3d& direction) const {
    int side = CEILING;
    double nearest = direction.z() > 0 ? distance_m[CEILING] / direction.z() : 1e9;
    const int x_side = direction.x() > 0 ? EAST : WEST, y_side = direction.y() > 0 ? NORTH : SOUTH;
    const double to_x = distance_m[x_side] / std::max(1e-9, std::abs(direction.x())),
                 to_y = distance_m[y_side] / std::max(1e-9, std::abs(direction.y()));
    if (to_x < nearest) nearest = to_x, side = x_side;
    if (to_y < nearest) nearest = to_y, side = y_side;
    const Eigen::Vector3d at = nearest * direction;
    const Eigen::Vector2d p = side == CEILING                ? Eigen::Vector2d(at.x(), at.y())
                              : side == EAST || side == WEST ? Eigen::Vector2d(at.y(), at.z())
                                                             : Eigen::Vector2d(at.x(), at.z());
    double shown = light[side];
    for (const Panel& panel : panels)
      if (panel.side == side && panel.covers(p)) shown = panel.light;
    return shown;
  }
};

// Panes with bars between them.
void add_window(Room& room, int side, Random& random) {
  const double pane_m = random.uniform(0.4, 0.9), height_m = random.uniform(0.8, 1.6);
  const double left_m = random.uniform(-2, 1), low_m = random.uniform(0.1, 0.6);
  const double light = random.uniform(3, 15);
  const int panes = 1 + random.below(4);
  for (int i = 0; i < panes; ++i) {
    const double x = left_m + i * (pane_m + 0.08);
    room.panels.push_back({side, {x, low_m}, {x + pane_m, low_m + height_m}, light});
  }
}

void add_cupboard(Room& room, int side, Random& random) {
  const double left_m = random.uniform(-2.5, 2), width_m = random.uniform(0.5, 1.5);
  room.panels.push_back({side,
                         {left_m, -1},
                         {left_m + width_m, random.uniform(0.3, 1.3)},
                         random.uniform(0.02, 0.5)});
}

// Rows of equal lamps.
void add_ceiling_lamps(Room& room, Random& random) {
  const int columns = 1 + random.below(3), rows = 1 + random.below(3);
  const Eigen::Vector2d size_m(random.uniform(0.15, 1.3), random.uniform(0.1, 0.4));
  const Eigen::Vector2d apart_m =
      size_m + Eigen::Vector2d(random.uniform(0.4, 1.5), random.uniform(0.6, 1.5));
  const Eigen::Vector2d first_m(random.uniform(-2.5, 0.5), random.uniform(-2.5, 0.5));
  const double light = random.uniform(5, 40);
  for (int i = 0; i < columns * rows; ++i) {
    const Eigen::Vector2d low =
        first_m + Eigen::Vector2d(i % columns, i / columns).cwiseProduct(apart_m);
    room.panels.push_back({CEILING, low, low + size_m, light});
  }
}

}  // namespace

FarLight random_room(Random random) {
  Room room;
  for (int side = EAST; side <= SOUTH; ++side) {
    room.distance_m[side] = random.uniform(1.2, 4.5);
    room.light[side] = random.uniform(0.15, 0.8);
  }
  room.distance_m[CEILING] = random.uniform(1.2, 3);
  room.light[CEILING] = random.uniform(0.4, 1.2);
  for (int side = EAST; side <= SOUTH; ++side) {
    if (random.uniform() < 0.35) add_window(room, side, random);
    for (int i = random.below(4); i > 0; --i) add_cupboard(room, side, random);
  }
  if (random.uniform() < 0.8) add_ceiling_lamps(room, random);
  const Eigen::AngleAxisd turn(random.uniform(0, 6.3), Eigen::Vector3d::UnitZ());
  return [room, turn](const Eigen::Vector3d& direction) { return room.seen(turn * direction); };
}

}  // namespace edgescout
