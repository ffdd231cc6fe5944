// Finds the viewpoint of an object that is nearest to a camera.
//
// The points that are visible from there are those that the camera sees, to within half the
// distance between viewpoints. Use it where drawing a depth map (visible_edges.h) would cost too
// much.
#pragma once

#include <span>
#include <vector>

#include <Eigen/Core>

#include "host/core/types.h"
#include "host/model/template_set.h"

namespace edgescout {

class ViewpointIndex {
 public:
  // `towards_camera`: unit vectors from the object's centre, object frame. Where they leave
  // directions out, the nearest one may be far.
  ViewpointIndex(std::span<const Eigen::Vector3d> towards_camera, const Eigen::Vector3d& center_m,
                 const Symmetries& symmetries = {});
  explicit ViewpointIndex(const TemplateSet& set);

  // A set holds viewpoints modulo symmetry: the viewpoint's points are visible at the equal pose
  // camera_from_object * symmetry(Nearest::symmetry). The first of equally near ones.
  struct Nearest {
    std::size_t viewpoint;
    std::size_t symmetry;
    double cosine;  // of the angle between the directions to the viewpoint and to the camera
  };
  Nearest nearest(const Se3& camera_from_object) const;
  const Se3& symmetry(std::size_t index) const { return symmetries_[index]; }

 private:
  Eigen::MatrixX3d towards_camera_;  // one row per viewpoint
  Eigen::Vector3d center_m_;
  std::vector<Se3> symmetries_;
};

}  // namespace edgescout
