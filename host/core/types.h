// The nouns of the system as plain structs: metres, radians, pixels.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "host/core/camera.h"
#include "host/core/se3.h"

namespace edgescout {

// Grey image, row-major, no padding.
struct Image {
  int width = 0;
  int height = 0;
  std::vector<std::uint8_t> pixels;
  std::uint8_t at(int x, int y) const { return pixels[static_cast<std::size_t>(y) * width + x]; }
};

// Triangle mesh in the object frame. Vertices are welded: no two share a position.
struct Mesh {
  std::string name;
  std::vector<Eigen::Vector3d> vertices_m;
  std::vector<std::array<int, 3>> triangles;  // counter-clockwise seen from outside
  std::vector<Eigen::Vector3d> face_normals;  // unit, one a triangle
  Eigen::Vector3d box_min_m = Eigen::Vector3d::Zero();
  Eigen::Vector3d box_max_m = Eigen::Vector3d::Zero();
  double diameter_m = 0;  // largest distance between two vertices
};

// Transforms that map the object onto itself. The identity is always the first member of
// `discrete`; a continuous symmetry (axis through a point) is sampled into `discrete` on load.
struct Symmetries {
  std::vector<Se3> discrete{Se3{}};
};

struct Object {
  int id = 1;  // BOP obj_id
  Mesh mesh;
  Symmetries symmetries;
};

// One 6-DoF hypothesis in one view.
struct Candidate {
  int object = 0;  // index into the caller's list of objects
  Se3 camera_from_object;
  double cost_px = 0;  // mean directional chamfer distance, lower is better
};

struct Detection {
  int object = 0;
  Se3 world_from_object;  // the world is the camera frame where only one view exists
  Matrix6d covariance = Matrix6d::Zero();  // tangent of core/se3.h
  double probability = 0;                  // calibrated, [0, 1]
  double psi = 0;                          // Eq. 10, [0, 1]
  double cost_px = 0;                      // mean tensor value over visible points
  double matched_fraction =
      0;  // of the predicted edge points, those with an edge of the image near
  double psi_z_score =
      0;  // of gradient directions, in standard errors above chance (register/pose_features.h)
  double unexplained_grey = 1;  // of the contrast inside the silhouette, what the surface does not
                                // explain (register/shading.h), [0, 1]
  std::string convergence;      // why the refinement stopped
};

}  // namespace edgescout
