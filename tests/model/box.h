// A box about the origin.
#pragma once

#include "host/io/mesh.h"

namespace edgescout::test {

inline Mesh box_mesh(double x_m, double y_m, double z_m) {
  std::vector<Eigen::Vector3d> corners;
  for (int i = 0; i < 8; ++i)
    corners.emplace_back(i & 1 ? x_m / 2 : -x_m / 2, i & 2 ? y_m / 2 : -y_m / 2,
                         i & 4 ? z_m / 2 : -z_m / 2);
  return make_mesh("box", corners,
                   {{0, 2, 3},
                    {0, 3, 1},
                    {4, 5, 7},
                    {4, 7, 6},
                    {0, 1, 5},
                    {0, 5, 4},
                    {2, 6, 7},
                    {2, 7, 3},
                    {0, 4, 6},
                    {0, 6, 2},
                    {1, 3, 7},
                    {1, 7, 5}});
}

}  // namespace edgescout::test
