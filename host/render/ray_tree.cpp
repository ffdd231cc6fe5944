#include "host/render/ray_tree.h"

#include <algorithm>

namespace edgescout {
namespace {

constexpr int LEAF_TRIANGLES = 4;

}  // namespace

struct RayTree::Ray {
  Eigen::Vector3f origin, direction;
  Eigen::Array3f inverse;
};

void RayTree::Box::add(const Box& other) {
  low = low.min(other.low);
  high = high.max(other.high);
}

RayTree::RayTree(const Mesh& mesh) {
  std::vector<Box> boxes;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    const auto& [a, b, c] = mesh.triangles[t];
    const Eigen::Vector3f x = mesh.vertices_m[a].cast<float>(),
                          y = mesh.vertices_m[b].cast<float>(),
                          z = mesh.vertices_m[c].cast<float>();
    triangles_.push_back({x, y - x, z - x, static_cast<int>(t)});
    boxes.push_back(
        {x.array().min(y.array()).min(z.array()), x.array().max(y.array()).max(z.array())});
  }
  Node root;
  root.count = static_cast<int>(triangles_.size());
  nodes_.push_back(root);
  split(0, boxes);
}

// Halves the node's triangles at the median along the longest side of their middles. `boxes` has
// one box for each triangle, by the triangle's index.
void RayTree::split(int node, std::vector<Box>& boxes) {
  const int first = nodes_[node].first, count = nodes_[node].count;
  const auto begin = triangles_.begin() + first, end = begin + count;
  Box all, middles;
  const auto twice_middle = [&](const Triangle& t) -> Eigen::Array3f {
    return boxes[t.index].low + boxes[t.index].high;
  };
  for (auto t = begin; t != end; ++t) {
    all.add(boxes[t->index]);
    middles.add({twice_middle(*t), twice_middle(*t)});
  }
  nodes_[node].box = all;
  if (count <= LEAF_TRIANGLES) return;
  int axis = 0;
  (middles.high - middles.low).maxCoeff(&axis);
  const auto median = begin + count / 2;
  std::nth_element(begin, median, end, [&](const Triangle& a, const Triangle& b) {
    return twice_middle(a)[axis] < twice_middle(b)[axis];
  });
  const int left = static_cast<int>(nodes_.size());
  nodes_[node].first = left;
  nodes_[node].count = 0;
  nodes_[node].axis = axis;
  nodes_.push_back({{}, first, count / 2});
  nodes_.push_back({{}, first + count / 2, count - count / 2});
  split(left, boxes);
  split(left + 1, boxes);
}

bool RayTree::meets(const Box& box, const Ray& ray, float nearest) {
  const Eigen::Array3f a = (box.low - ray.origin.array()) * ray.inverse,
                       b = (box.high - ray.origin.array()) * ray.inverse;
  const float enter = std::max(0.0f, a.min(b).maxCoeff()),
              leave = std::min(nearest, a.max(b).minCoeff());
  return enter <= leave;
}

// Moeller and Trumbore (1997).
void RayTree::meet(const Triangle& t, const Ray& ray, RayHit& hit) {
  const Eigen::Vector3f p = ray.direction.cross(t.edge_b_m);
  const float determinant = t.edge_a_m.dot(p);
  if (determinant == 0) return;
  const Eigen::Vector3f s = ray.origin - t.corner_m, q = s.cross(t.edge_a_m);
  const float u = s.dot(p) / determinant, v = ray.direction.dot(q) / determinant;
  const float distance = t.edge_b_m.dot(q) / determinant;
  if (!(u >= 0 && v >= 0 && u + v <= 1 && distance > 0 && distance < hit.distance_m)) return;
  hit = {t.index, distance};
}

void RayTree::intersect(const Eigen::Vector3d& origin_m, const Eigen::Vector3d& direction,
                        RayHit& hit) const {
  Ray ray{origin_m.cast<float>(), direction.cast<float>(), {}};
  // Not zero: zero times infinity has no value.
  ray.inverse = (ray.direction.array() == 0).select(1e-20f, ray.direction.array()).inverse();
  std::array<int, 64> stack;
  int depth = 0;
  stack[depth++] = 0;
  while (depth > 0) {
    const Node& node = nodes_[stack[--depth]];
    if (!meets(node.box, ray, static_cast<float>(hit.distance_m))) continue;
    for (int i = 0; i < node.count; ++i) meet(triangles_[node.first + i], ray, hit);
    if (node.count > 0) continue;
    const int near = ray.direction[node.axis] < 0 ? 1 : 0;
    stack[depth++] = node.first + 1 - near;
    stack[depth++] = node.first + near;
  }
}

}  // namespace edgescout
