// The poses of one object that a prior in the world admits, as one camera sees them.
#pragma once

#include <Eigen/Geometry>
#include <optional>
#include <span>
#include <vector>

#include "host/detect/world_prior.h"

namespace edgescout {

// How far beside the admitted poses a pose may lie that alignment still moves there.
struct SearchSlack {
  double place_m = 0;         // in any direction
  double distance_ratio = 1;  // between neighbouring distances from the camera: half way to either
};

class SearchSpace {
 public:
  SearchSpace(const WorldPrior& prior, const EdgeModel& model, const Se3& camera_from_world);

  // Without a prior every pose is admitted.
  bool is_everywhere() const { return !box_m_ && !plane_; }

  // Whether the object's centre may lie at this distance along `ray`, a unit vector in the camera
  // frame. True for all places of admitted poses, whatever the object's rotation there.
  bool meets(const Eigen::Vector3d& ray, double distance_m, const SearchSlack& slack = {}) const;
  // Whether the object may have this pose. Its lowest point is that of the occluding surface; of
  // more than 642 vertices it is known to 1 % of the radius, from those farthest in 642 directions.
  bool admits(const Se3& camera_from_object, const SearchSlack& slack = {}) const;

 private:
  bool reaches(const Eigen::Vector3d& ray, double distance_m, double lowest_m,
               const SearchSlack& slack) const;
  double lowest_point_m(const Eigen::Quaterniond& camera_from_object) const;

  Se3 prior_from_camera_;
  std::optional<Eigen::AlignedBox3d> box_m_;
  std::optional<Eigen::Hyperplane<double, 3>> plane_;  // that no point of the object lies below
  Eigen::Vector3d center_m_;                           // of the object
  double radius_m_;
  std::vector<Eigen::Vector3d> extremes_m_;  // vertices from the centre; of no use without a plane
};

// By model, for poses in the world.
std::vector<SearchSpace> search_spaces(const WorldPrior& prior, std::span<const EdgeModel> models);

}  // namespace edgescout
