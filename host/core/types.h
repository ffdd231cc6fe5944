// Basic types as plain structs: images, meshes, objects, poses, detections. Units: m, rad, px.
//
// Public header.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "host/core/camera.h"
#include "host/core/se3.h"

namespace edgescout {

// Grey image, row-major, without padding.
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
  std::vector<Eigen::Vector3d> face_normals;  // unit, one per triangle
  Eigen::Vector3d box_min_m = Eigen::Vector3d::Zero();
  Eigen::Vector3d box_max_m = Eigen::Vector3d::Zero();
  double diameter_m = 0;  // largest distance between two vertices
};

// Transforms that map the object onto itself. The first member of `discrete` is always the
// identity. Loading samples a continuous symmetry (an axis through a point) into `discrete`.
struct Symmetries {
  std::vector<Se3> discrete{Se3{}};
};

struct Object {
  int id = 1;  // BOP obj_id
  Mesh mesh;
  Symmetries symmetries;
};

// An object and its pose. `object` indexes the caller's list of objects. With a single view the
// world may be its camera frame.
struct ObjectPose {
  int object = 0;
  Se3 world_from_object;
};

// Another pose of a detected object that explains much of the same edges (detect/alternatives.h).
struct AlternativePose {
  Se3 world_from_object;
  double probability = 0;  // calibrated, [0, 1]
};

// The report on one object that was found.
struct Detection : ObjectPose {
  Matrix6d covariance = Matrix6d::Zero();  // tangent of core/se3.h
  double probability = 0;                  // calibrated, [0, 1]
  double psi = 0;                          // Eq. 10, [0, 1]
  double cost_px = 0;                      // mean tensor value over visible points
  double matched_fraction = 0;  // of the visible edge points: those with an image edge near
  double psi_z_score = 0;       // psi above chance, in standard errors (register/pose_features.h)
  // Fraction of the contrast inside the silhouette that the surface does not explain
  // (register/shading.h), [0, 1].
  double unexplained_grey = 1;
  std::string convergence;                    // why the refinement stopped
  std::vector<AlternativePose> alternatives;  // most probable first
};

}  // namespace edgescout
