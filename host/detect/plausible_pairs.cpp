#include "host/detect/plausible_pairs.h"

#include <fcl/geometry/bvh/BVH_model.h>
#include <fcl/math/bv/OBBRSS.h>
#include <fcl/narrowphase/collision.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <numbers>
#include <numeric>

#include "host/core/order.h"
#include "host/model/viewpoints.h"
#include "kernels/error.h"
#include "kernels/thread_pool.h"

namespace edgescout {

namespace {

using Tree = fcl::BVHModel<fcl::OBBRSSd>;

// A mesh prepared for the tests. One vertex of every connected piece is enough to know whether the
// piece lies inside something that it does not cut.
struct Solid {
  const EdgeModel* model;
  std::shared_ptr<Tree> tree;           // of triangles
  std::vector<Eigen::Vector3d> pieces;  // one vertex each
};

std::vector<Eigen::Vector3d> vertex_of_each_piece(const Mesh& mesh) {
  std::vector<int> parent(mesh.vertices_m.size());
  std::iota(parent.begin(), parent.end(), 0);
  const auto root = [&](int v) {
    while (parent[v] != v) v = parent[v] = parent[parent[v]];
    return v;
  };
  for (const std::array<int, 3>& t : mesh.triangles)
    for (int corner : {1, 2}) parent[root(t[corner])] = root(t[0]);
  std::vector<Eigen::Vector3d> pieces;
  for (int v = 0; v < int(parent.size()); ++v)
    if (parent[v] == v) pieces.push_back(mesh.vertices_m[v]);
  return pieces;
}

Solid make_solid(const EdgeModel& model) {
  auto tree = std::make_shared<Tree>();
  std::vector<fcl::Triangle> triangles;
  for (const std::array<int, 3>& t : model.mesh.triangles) triangles.emplace_back(t[0], t[1], t[2]);
  tree->beginModel();
  tree->addSubModel(model.mesh.vertices_m, triangles);
  tree->endModel();
  return {&model, std::move(tree), vertex_of_each_piece(model.mesh)};
}

// By the winding number: the solid angle of all triangles seen from the point, over 4 pi (Van
// Oosterom & Strackee 1983). It works for meshes with small holes, too.
bool inside(const Mesh& mesh, const Eigen::Vector3d& point) {
  double half_angles = 0;
  for (const std::array<int, 3>& t : mesh.triangles) {
    const Eigen::Vector3d a = mesh.vertices_m[t[0]] - point, b = mesh.vertices_m[t[1]] - point,
                          c = mesh.vertices_m[t[2]] - point;
    const double la = a.norm(), lb = b.norm(), lc = c.norm();
    half_angles +=
        std::atan2(a.dot(b.cross(c)), la * lb * lc + a.dot(b) * lc + b.dot(c) * la + c.dot(a) * lb);
  }
  return std::abs(half_angles) > std::numbers::pi;
}

bool contains_a_piece(const Solid& outer, const Solid& inner, const Se3& outer_from_inner) {
  for (const Eigen::Vector3d& vertex : inner.pieces) {
    const Eigen::Vector3d in_outer = outer_from_inner * vertex;
    const bool in_box = (in_outer.array() >= outer.model->mesh.box_min_m.array()).all() &&
                        (in_outer.array() <= outer.model->mesh.box_max_m.array()).all();
    if (in_box && inside(outer.model->mesh, in_outer)) return true;
  }
  return false;
}

fcl::Transform3d transform(const Se3& pose) {
  fcl::Transform3d t = fcl::Transform3d::Identity();
  t.linear() = pose.rotation.toRotationMatrix();
  t.translation() = pose.translation_m;
  return t;
}

// Two posed solids, in the frame of the first.
class Pair {
 public:
  Pair(const Solid& a, const Solid& b, const Se3& a_from_b) : a_(a), b_(b), a_from_b_(a_from_b) {}

  bool overlap(const Eigen::Vector3d& push_m) const {
    const Se3 pushed{a_from_b_.rotation, a_from_b_.translation_m + push_m};
    return !contacts(pushed, 1).empty() || contains_a_piece(a_, b_, pushed) ||
           contains_a_piece(b_, a_, inverse(pushed));
  }

  // Normals of the faces that cut each other, with both signs.
  std::vector<Eigen::Vector3d> contact_normals() const {
    constexpr std::size_t most = 48;
    std::vector<Eigen::Vector3d> normals;
    const auto add = [&](const Eigen::Vector3d& n) {
      for (const Eigen::Vector3d& known : normals)
        if (known.dot(n) > 0.99) return;
      normals.push_back(n);
    };
    for (const fcl::Contactd& contact : contacts(a_from_b_, most)) {
      const Eigen::Vector3d& of_a = a_.model->mesh.face_normals[contact.b1];
      const Eigen::Vector3d of_b = a_from_b_.rotation * b_.model->mesh.face_normals[contact.b2];
      add(of_a), add(-of_b), add(-of_a), add(of_b);
    }
    return normals;
  }

 private:
  std::vector<fcl::Contactd> contacts(const Se3& a_from_b, std::size_t most) const {
    const fcl::CollisionRequestd request(most);
    fcl::CollisionResultd result;
    fcl::collide(a_.tree.get(), fcl::Transform3d::Identity(), b_.tree.get(), transform(a_from_b),
                 request, result);
    std::vector<fcl::Contactd> found;
    result.getContacts(found);
    return found;
  }

  const Solid &a_, &b_;
  Se3 a_from_b_;
};

bool can_coexist(const Pair& pair, double penetration_m) {
  if (!pair.overlap(Eigen::Vector3d::Zero())) return true;
  if (penetration_m == 0) return false;
  for (const Eigen::Vector3d& direction : pair.contact_normals())
    // The shorter push helps where something is on the other side, too.
    for (const double length_m : {penetration_m, 0.5 * penetration_m})
      if (!pair.overlap(length_m * direction)) return true;
  static const std::vector<Eigen::Vector3d> around = icosphere(2);
  for (const Eigen::Vector3d& direction : around)
    if (!pair.overlap(penetration_m * direction)) return true;
  return false;
}

}  // namespace

BitMatrix plausible_pairs(std::span<const EdgeModel> models, std::span<const ObjectPose> candidates,
                          double penetration_m, ThreadPool& pool) {
  if (!(penetration_m >= 0 && penetration_m <= 1))
    throw InputError("options", "penetration", std::to_string(penetration_m),
                     "a length in [0, 1] m");
  const std::size_t count = candidates.size();
  std::vector<Solid> solids;
  if (count > 1)
    for (const EdgeModel& model : models) solids.push_back(make_solid(model));
  std::vector<char> is_plausible(count * count, 1);
  pool.for_each(count * count, [&](std::size_t cell) {
    const std::size_t i = cell / count, j = cell % count;
    if (j >= i) return;
    const ObjectPose &a = candidates[i], &b = candidates[j];
    const Solid &solid_a = solids[a.object], &solid_b = solids[b.object];
    const double reach_m = solid_a.model->radius_m + solid_b.model->radius_m;
    if (((a.world_from_object * solid_a.model->center_m) -
         (b.world_from_object * solid_b.model->center_m))
            .norm() > reach_m)
      return;
    is_plausible[cell] = is_plausible[j * count + i] = can_coexist(
        Pair(solid_a, solid_b, inverse(a.world_from_object) * b.world_from_object), penetration_m);
  });
  BitMatrix plausible(count, count);
  for (std::size_t i = 0; i < count; ++i)
    for (std::size_t j = 0; j < count; ++j)
      if (is_plausible[i * count + j]) plausible.set(i, j);
  return plausible;
}

namespace {

// Probability that none of these candidates is there. Probabilities of those that exclude each
// other add up; others are independent.
double probability_of_none(std::span<const std::size_t> candidates,
                           std::span<const double> probabilities, const BitMatrix& plausible) {
  std::vector<std::vector<std::size_t>> groups;  // the members of a group exclude each other
  for (const std::size_t c : candidates) {
    const auto home = std::ranges::find_if(groups, [&](const auto& group) {
      return std::ranges::none_of(group,
                                  [&](std::size_t other) { return plausible.has(c, other); });
    });
    if (home == groups.end())
      groups.push_back({c});
    else
      home->push_back(c);
  }
  double none = 1;
  for (const auto& group : groups) {
    double some = 0;
    for (const std::size_t c : group) some += probabilities[c];
    none *= std::max(0.0, 1 - some);
  }
  return none;
}

}  // namespace

std::vector<double> exclusive_probabilities(std::span<const double> probabilities,
                                            const BitMatrix& plausible) {
  check(plausible.rows == probabilities.size() && plausible.columns == probabilities.size(),
        "exclusive_probabilities: a row and a column a candidate");
  const std::vector<std::size_t> order = largest_first(probabilities);
  std::vector<double> left(probabilities.begin(), probabilities.end());
  for (std::size_t i = 0; i < order.size(); ++i) {
    std::vector<std::size_t> excluding;
    for (std::size_t j = 0; j < i; ++j)
      if (!plausible.has(order[i], order[j])) excluding.push_back(order[j]);
    left[order[i]] *= probability_of_none(excluding, left, plausible);
  }
  return left;
}

std::vector<double> probabilities_without_collisions(std::span<const EdgeModel> models,
                                                     std::span<const PoseEstimate> poses,
                                                     double penetration_m, ThreadPool& pool) {
  constexpr double negligible = 0.01;  // a pose less probable is as good as ruled out already
  std::vector<double> probabilities, of_placed;
  std::vector<ObjectPose> placed;  // poses that several views inform
  std::vector<std::size_t> placed_index;
  for (std::size_t i = 0; i < poses.size(); ++i) {
    probabilities.push_back(poses[i].classification.probability);
    if (probabilities[i] < negligible || poses[i].classification.informative_views < 2) continue;
    of_placed.push_back(probabilities[i]);
    placed.push_back(poses[i]);
    placed_index.push_back(i);
  }
  const std::vector<double> left =
      exclusive_probabilities(of_placed, plausible_pairs(models, placed, penetration_m, pool));
  for (std::size_t i = 0; i < left.size(); ++i) probabilities[placed_index[i]] = left[i];
  return probabilities;
}

}  // namespace edgescout
