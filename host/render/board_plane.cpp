#include "host/render/board_plane.h"

namespace edgescout {

BoardPlane::BoardPlane(const SimulatedScene& scene)
    : scene_(scene), board_from_world_(inverse(scene.world_from_board)) {}

// The print's rows go down, the board's y goes up. Without the flip, words would be mirrored.
Eigen::Vector2d BoardPlane::print_px(const Eigen::Vector3d& point_m) const {
  const Eigen::Vector3d p = board_from_world_ * point_m;
  const double scale = scene_.board.width / scene_.board_side_m;
  return {p.x() * scale + 0.5 * (scene_.board.width - 1),
          0.5 * (scene_.board.height - 1) - p.y() * scale};
}

bool BoardPlane::is_board(const Eigen::Vector3d& point_m) const {
  if (scene_.board_side_m <= 0) return false;
  const Eigen::Vector2d px = print_px(point_m);
  return px.x() >= 0 && px.y() >= 0 && px.x() < scene_.board.width - 1 &&
         px.y() < scene_.board.height - 1;
}

double BoardPlane::albedo(const Eigen::Vector3d& point_m) const {
  if (!is_board(point_m)) return scene_.desk_albedo;
  const Image& print = scene_.board;
  const Eigen::Vector2d px = print_px(point_m);
  const int x = static_cast<int>(px.x()), y = static_cast<int>(px.y());
  const double fu = px.x() - x, fv = px.y() - y;
  const double top = (1 - fu) * print.at(x, y) + fu * print.at(x + 1, y);
  const double bottom = (1 - fu) * print.at(x, y + 1) + fu * print.at(x + 1, y + 1);
  return ((1 - fv) * top + fv * bottom) / 255;
}

}  // namespace edgescout
