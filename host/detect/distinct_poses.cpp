#include "host/detect/distinct_poses.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <map>
#include <numeric>

#include "kernels/error.h"
#include "kernels/thread_pool.h"

namespace edgescout {

namespace {

// Under the identity symmetry. Infinite, without looking further, where it exceeds `limit`.
double corner_distance_m(const Se3& a, const Se3& b, const std::array<Eigen::Vector3d, 8>& corners,
                         double limit) {
  const Eigen::Matrix3d turn = a.rotation.toRotationMatrix() - b.rotation.toRotationMatrix();
  const Eigen::Vector3d shift = a.translation_m - b.translation_m;
  double worst2 = 0;
  for (const Eigen::Vector3d& corner : corners) {
    worst2 = std::max(worst2, (turn * corner + shift).squaredNorm());
    if (worst2 >= limit * limit) return std::numeric_limits<double>::infinity();
  }
  return std::sqrt(worst2);
}

std::vector<std::size_t> by_key(std::span<const double> keys) {
  std::vector<std::size_t> order(keys.size());
  std::iota(order.begin(), order.end(), 0);
  std::ranges::stable_sort(order, {}, [&](std::size_t i) { return keys[i]; });
  return order;
}

// The centre of an object's box and its corners, scaled about the camera until the centre is 1 m
// away.
struct ScaledBox {
  Eigen::Vector3d center;
  std::array<Eigen::Vector3d, 8> corners;

  ScaledBox(const Se3& camera_from_object, const Eigen::Vector3d& center_m,
            const std::array<Eigen::Vector3d, 8>& corners_m)
      : center(camera_from_object * center_m) {
    const double scale = 1 / center.norm();
    const Eigen::Matrix3d rotation = camera_from_object.rotation.toRotationMatrix();
    center *= scale;
    for (int i = 0; i < 8; ++i)
      corners[i] = scale * (rotation * corners_m[i] + camera_from_object.translation_m);
  }
  // No corner is further apart than this.
  bool is_within(double radius, const ScaledBox& other) const {
    if ((center - other.center).squaredNorm() > radius * radius) return false;
    for (int i = 0; i < 8; ++i)
      if ((corners[i] - other.corners[i]).squaredNorm() > radius * radius) return false;
    return true;
  }
};

// Boxes by the place of their centres in the image.
class BoxesInView {
 public:
  explicit BoxesInView(double largest_radius) : cell_(largest_radius) {}
  void add(const ScaledBox& box) { cells_[cell_of(box, 0, 0)].push_back(box); }
  void add(const BoxesInView& others) {
    for (const auto& [cell, boxes] : others.cells_)
      cells_[cell].insert(cells_[cell].end(), boxes.begin(), boxes.end());
  }
  bool any_within(double radius, const ScaledBox& box) const {
    for (int dx = -1; dx <= 1; ++dx)
      for (int dy = -1; dy <= 1; ++dy) {
        const auto cell = cells_.find(cell_of(box, dx, dy));
        if (cell != cells_.end() && std::ranges::any_of(cell->second, [&](const ScaledBox& b) {
              return box.is_within(radius, b);
            }))
          return true;
      }
    return false;
  }

 private:
  std::pair<int, int> cell_of(const ScaledBox& box, int dx, int dy) const {
    return {int(std::floor(box.center.x() / cell_)) + dx,
            int(std::floor(box.center.y() / cell_)) + dy};
  }
  double cell_;
  std::map<std::pair<int, int>, std::vector<ScaledBox>> cells_;
};

// Those that are compared with the kept ones at once.
constexpr std::size_t CHUNK_POSES = 1024;

// Poses of one object in the frame of a camera.
class PosesInView {
 public:
  PosesInView(std::span<const Se3> camera_from_object, const Mesh& mesh,
              const Symmetries& symmetries, double fraction)
      : camera_from_object_(camera_from_object),
        symmetries_(symmetries.discrete),
        center_m_(0.5 * (mesh.box_min_m + mesh.box_max_m)),
        corners_m_(box_corners(mesh)),
        radius_m_(fraction * mesh.diameter_m) {}

  double largest_radius() const {
    double largest = 0;
    for (std::size_t i = 0; i < camera_from_object_.size(); ++i)
      largest = std::max(largest, radius(i));
    return largest;
  }
  ScaledBox box(std::size_t i) const { return {camera_from_object_[i], center_m_, corners_m_}; }
  bool is_near(std::size_t i, const BoxesInView& boxes) const {
    return std::ranges::any_of(symmetries_, [&](const Se3& symmetry) {
      return boxes.any_within(radius(i),
                              {camera_from_object_[i] * symmetry, center_m_, corners_m_});
    });
  }

 private:
  double radius(std::size_t i) const {
    return radius_m_ / (camera_from_object_[i] * center_m_).norm();
  }

  std::span<const Se3> camera_from_object_, symmetries_;
  Eigen::Vector3d center_m_;
  std::array<Eigen::Vector3d, 8> corners_m_;
  double radius_m_;
};

}  // namespace

std::array<Eigen::Vector3d, 8> box_corners(const Mesh& mesh) {
  std::array<Eigen::Vector3d, 8> corners;
  for (int i = 0; i < 8; ++i)
    for (int axis = 0; axis < 3; ++axis)
      corners[i][axis] = (i >> axis & 1) ? mesh.box_max_m[axis] : mesh.box_min_m[axis];
  return corners;
}

double pose_distance_m(const Se3& a, const Se3& b, const Mesh& mesh, const Symmetries& symmetries) {
  const std::array<Eigen::Vector3d, 8> corners = box_corners(mesh);
  double best = std::numeric_limits<double>::infinity();
  for (const Se3& symmetry : symmetries.discrete)
    best = std::min(best, corner_distance_m(a, b * symmetry, corners, best));
  return best;
}

KnownPoses::KnownPoses(std::span<const Se3> poses, const Mesh& mesh, const Symmetries& symmetries)
    : symmetries_(symmetries.discrete),
      corners_(box_corners(mesh)),
      center_m_(0.5 * (mesh.box_min_m + mesh.box_max_m)) {
  for (const Se3& symmetry : symmetries_)
    center_motion_m_ = std::max(center_motion_m_, (symmetry * center_m_ - center_m_).norm());
  for (const Se3& pose : poses) add(pose);
}

void KnownPoses::add(const Se3& pose) {
  poses_.push_back(pose);
  centers_m_.push_back(pose * center_m_);
}

bool KnownPoses::any_within(double radius_m, const Se3& pose) const {
  const Eigen::Vector3d here = pose * center_m_;
  // Some corner moves at least as far as the centre.
  const double reach_m = radius_m + center_motion_m_;
  for (std::size_t k = 0; k < poses_.size(); ++k) {
    if ((centers_m_[k] - here).squaredNorm() > reach_m * reach_m) continue;
    for (const Se3& symmetry : symmetries_)
      if (corner_distance_m(pose, poses_[k] * symmetry, corners_, radius_m) < radius_m) return true;
  }
  return false;
}

std::vector<std::size_t> suppress_duplicates(std::span<const Se3> poses_best_first,
                                             const Mesh& mesh, const Symmetries& symmetries,
                                             double radius_m, std::size_t most) {
  std::vector<std::size_t> kept;
  KnownPoses known({}, mesh, symmetries);
  for (std::size_t i = 0; i < poses_best_first.size() && kept.size() < most; ++i) {
    if (known.any_within(radius_m, poses_best_first[i])) continue;
    kept.push_back(i);
    known.add(poses_best_first[i]);
  }
  return kept;
}

std::vector<std::size_t> best_distinct(std::span<const Se3> poses, std::span<const double> keys,
                                       const Mesh& mesh, const Symmetries& symmetries,
                                       double radius_m, std::size_t most) {
  check(poses.size() == keys.size(), "best_distinct: one key a pose");
  const std::vector<std::size_t> order = by_key(keys);
  std::vector<Se3> ordered;
  for (std::size_t i : order) ordered.push_back(poses[i]);
  std::vector<std::size_t> best;
  for (std::size_t i : suppress_duplicates(ordered, mesh, symmetries, radius_m, most))
    best.push_back(order[i]);
  return best;
}

std::vector<std::size_t> best_distinct_in_view(std::span<const Se3> camera_from_object,
                                               std::span<const double> keys, const Mesh& mesh,
                                               const Symmetries& symmetries,
                                               const DistinctInView& limits, ThreadPool& threads) {
  check(camera_from_object.size() == keys.size(), "best_distinct_in_view: one key a pose");
  const PosesInView poses(camera_from_object, mesh, symmetries, limits.fraction);
  const std::vector<std::size_t> order = by_key(keys);
  std::vector<std::size_t> best;
  BoxesInView kept(poses.largest_radius());
  for (std::size_t first = 0; first < order.size() && best.size() < limits.most;
       first += CHUNK_POSES) {
    const auto chunk = std::span(order).subspan(first, std::min(CHUNK_POSES, order.size() - first));
    std::vector<std::uint8_t> is_near(chunk.size());
    for_each_in_chunks(threads, chunk.size(), 16,
                       [&](std::size_t i) { is_near[i] = poses.is_near(chunk[i], kept); });
    BoxesInView of_chunk(poses.largest_radius());
    for (std::size_t i = 0; i < chunk.size() && best.size() < limits.most; ++i) {
      if (is_near[i] || poses.is_near(chunk[i], of_chunk)) continue;
      of_chunk.add(poses.box(chunk[i]));
      best.push_back(chunk[i]);
    }
    kept.add(of_chunk);
  }
  return best;
}

}  // namespace edgescout
