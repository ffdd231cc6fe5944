#include "host/detect/search_space.h"

#include <algorithm>
#include <cmath>
#include <set>

namespace edgescout {

namespace {

// A part of a ray: from `from` to `to` along it; empty where `to` is less.
struct Interval {
  double from, to;
  // Keeps where offset + slope * t >= 0.
  void clip(double offset, double slope) {
    if (slope > 0)
      from = std::max(from, -offset / slope);
    else if (slope < 0)
      to = std::min(to, -offset / slope);
    else if (offset < 0)
      to = -INFINITY;
  }
};

// The vertices that lie farthest in many directions, of few vertices all.
std::vector<Eigen::Vector3d> extreme_vertices_m(const OccludingSurface& surface) {
  const Eigen::Map<const Eigen::Matrix3Xf> vertices(surface.vertices_m.data(), 3,
                                                    Eigen::Index(surface.vertices_m.size() / 3));
  const std::vector<Eigen::Vector3d> directions = icosphere(8);
  std::set<Eigen::Index> extremes;
  for (const Eigen::Vector3d& direction : directions) {
    Eigen::Index farthest;
    (direction.cast<float>().transpose() * vertices).maxCoeff(&farthest);
    extremes.insert(farthest);
  }
  if (vertices.cols() <= Eigen::Index(directions.size()))
    for (Eigen::Index i = 0; i < vertices.cols(); ++i) extremes.insert(i);
  std::vector<Eigen::Vector3d> vertices_m;
  for (const Eigen::Index i : extremes) vertices_m.push_back(vertices.col(i).cast<double>());
  return vertices_m;
}

}  // namespace

SearchSpace::SearchSpace(const WorldPrior& prior, const EdgeModel& model,
                         const Se3& camera_from_world)
    : prior_from_camera_(prior.prior_from_world * inverse(camera_from_world)),
      center_m_(model.center_m),
      radius_m_(model.radius_m) {
  if (!prior.box_m.empty()) box_m_ = prior.box();
  if (prior.plane.empty()) return;
  plane_ = prior.lowest_plane();
  extremes_m_ = extreme_vertices_m(model.occluding);
  for (Eigen::Vector3d& vertex : extremes_m_) vertex -= center_m_;
}

// `lowest_m`: height of the object's lowest point above its centre, mostly negative.
bool SearchSpace::reaches(const Eigen::Vector3d& ray, double distance_m, double lowest_m,
                          const SearchSlack& slack) const {
  const Eigen::Vector3d& eye = prior_from_camera_.translation_m;
  const Eigen::Vector3d along = prior_from_camera_.rotation * ray;
  const double half_way = std::sqrt(slack.distance_ratio);
  Interval interval{distance_m / half_way, distance_m * half_way};
  if (box_m_)
    for (int axis = 0; axis < 3; ++axis) {
      interval.clip(eye[axis] - box_m_->min()[axis] + slack.place_m, along[axis]);
      interval.clip(box_m_->max()[axis] - eye[axis] + slack.place_m, -along[axis]);
    }
  if (plane_)
    interval.clip(plane_->signedDistance(eye) + lowest_m + slack.place_m,
                  plane_->normal().dot(along));
  return interval.from <= interval.to;
}

double SearchSpace::lowest_point_m(const Eigen::Quaterniond& camera_from_object) const {
  const Eigen::Vector3d up =
      (prior_from_camera_.rotation * camera_from_object).inverse() * plane_->normal();
  double lowest_m = INFINITY;
  for (const Eigen::Vector3d& vertex : extremes_m_) lowest_m = std::min(lowest_m, up.dot(vertex));
  return lowest_m;
}

bool SearchSpace::meets(const Eigen::Vector3d& ray, double distance_m,
                        const SearchSlack& slack) const {
  // The centre of a bounding box may lie outside the object, even below all of it.
  return is_everywhere() || reaches(ray, distance_m, radius_m_, slack);
}

bool SearchSpace::admits(const Se3& camera_from_object, const SearchSlack& slack) const {
  if (is_everywhere()) return true;
  const Eigen::Vector3d center_m = camera_from_object * center_m_, ray = center_m.normalized();
  const double distance_m = center_m.norm();
  return reaches(ray, distance_m, -radius_m_, slack) ||
         (plane_ && reaches(ray, distance_m, lowest_point_m(camera_from_object.rotation), slack));
}

std::vector<SearchSpace> search_spaces(const WorldPrior& prior, std::span<const EdgeModel> models) {
  std::vector<SearchSpace> spaces;
  for (const EdgeModel& model : models) spaces.emplace_back(prior, model, Se3{});
  return spaces;
}

}  // namespace edgescout
