// Which of a set's viewpoints stands nearest to a camera: what shows from there is what the camera
// sees, to within ICOSPHERE_GAP_RAD / frequency (viewpoints.h; nine degrees at the default, five in
// the mean). A set whose range leaves directions out gives the nearest there is, however far.
#pragma once

#include <Eigen/Core>

#include "host/model/template_set.h"

namespace edgescout {

class NearestViewpoint {
 public:
  // Keeps a reference to the set.
  explicit NearestViewpoint(const TemplateSet& set);

  // A set holds viewpoints modulo symmetry: the nearest may belong to another of the object's equal
  // poses, camera_from_object * symmetry.
  struct Found {
    std::size_t view;  // of TemplateSet::views
    const Se3* symmetry;
  };
  Found of(const Se3& camera_from_object) const;

 private:
  const TemplateSet& set_;
  Eigen::MatrixX3d towards_camera_;  // one row a view
};

}  // namespace edgescout
