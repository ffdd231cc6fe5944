// The plane z = 0 of a scene: its board and the desk around it.
#pragma once

#include "host/render/scene.h"

namespace edgescout {

class BoardPlane {
 public:
  explicit BoardPlane(const SimulatedScene& scene);  // `scene` must outlive this

  // Of a point on the plane, world frame.
  bool is_board(const Eigen::Vector3d& point_m) const;
  double albedo(const Eigen::Vector3d& point_m) const;  // of the print or the desk

 private:
  Eigen::Vector2d print_px(const Eigen::Vector3d& point_m) const;
  const SimulatedScene& scene_;
  Se3 board_from_world_;
};

}  // namespace edgescout
