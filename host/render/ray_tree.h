// Finds the first triangle of a mesh along a ray, with a bounding volume hierarchy.
#pragma once

#include <array>
#include <limits>
#include <vector>

#include "host/core/types.h"

namespace edgescout {

struct RayHit {
  int triangle = -1;  // index into Mesh::triangles; -1: nothing
  double distance_m = std::numeric_limits<double>::infinity();
};

class RayTree {
 public:
  explicit RayTree(const Mesh& mesh);

  // The nearest triangle, of either orientation, that the ray meets before `hit.distance_m`.
  // Changes `hit` if there is one. `direction`: unit. Single precision: a hit is exact to 1e-5 of
  // the mesh's diameter.
  void intersect(const Eigen::Vector3d& origin_m, const Eigen::Vector3d& direction,
                 RayHit& hit) const;

 private:
  struct Box {
    Eigen::Array3f low = Eigen::Array3f::Constant(std::numeric_limits<float>::infinity());
    Eigen::Array3f high = -low;
    void add(const Box& other);
  };
  struct Node {
    Box box;
    int first = 0;  // of its triangles, or of its two children
    int count = 0;  // of triangles; 0: an inner node
    int axis = 0;   // along which the first child lies before the second
  };
  struct Triangle {
    Eigen::Vector3f corner_m, edge_a_m, edge_b_m;
    int index = 0;
  };
  struct Ray;
  void split(int node, std::vector<Box>& boxes);
  static bool meets(const Box& box, const Ray& ray, float nearest);
  static void meet(const Triangle& triangle, const Ray& ray, RayHit& hit);

  std::vector<Node> nodes_;
  std::vector<Triangle> triangles_;
};

}  // namespace edgescout
