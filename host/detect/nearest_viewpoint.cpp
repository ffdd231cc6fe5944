#include "host/detect/nearest_viewpoint.h"

namespace edgescout {

NearestViewpoint::NearestViewpoint(const TemplateSet& set)
    : set_(set), towards_camera_(Eigen::Index(set.views.size()), 3) {
  for (std::size_t v = 0; v < set.views.size(); ++v)
    towards_camera_.row(Eigen::Index(v)) =
        set.views[v].camera_from_object.inverse() * -Eigen::Vector3d::UnitZ();
}

NearestViewpoint::Found NearestViewpoint::of(const Se3& camera_from_object) const {
  Found best{};
  double largest = -2;
  for (const Se3& symmetry : set_.symmetries.discrete) {
    const Se3 equal = camera_from_object * symmetry;
    const Eigen::Vector3d to_camera =
        (inverse(equal).translation_m - set_.model.center_m).normalized();
    Eigen::Index nearest = 0;
    const double cosine = (towards_camera_ * to_camera).maxCoeff(&nearest);
    if (cosine > largest) largest = cosine, best = {std::size_t(nearest), &symmetry};
  }
  return best;
}

}  // namespace edgescout
