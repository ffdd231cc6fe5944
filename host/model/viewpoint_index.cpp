#include "host/model/viewpoint_index.h"

namespace edgescout {

namespace {

std::vector<Eigen::Vector3d> directions_of(const TemplateSet& set) {
  std::vector<Eigen::Vector3d> towards_camera;
  for (const TemplateView& view : set.views)
    towards_camera.push_back(view.camera_from_object.inverse() * -Eigen::Vector3d::UnitZ());
  return towards_camera;
}

}  // namespace

ViewpointIndex::ViewpointIndex(std::span<const Eigen::Vector3d> towards_camera,
                               const Eigen::Vector3d& center_m, const Symmetries& symmetries)
    : towards_camera_(Eigen::Index(towards_camera.size()), 3),
      center_m_(center_m),
      symmetries_(symmetries.discrete) {
  for (std::size_t v = 0; v < towards_camera.size(); ++v)
    towards_camera_.row(Eigen::Index(v)) = towards_camera[v];
}

ViewpointIndex::ViewpointIndex(const TemplateSet& set)
    : ViewpointIndex(directions_of(set), set.model.center_m, set.symmetries) {}

ViewpointIndex::Nearest ViewpointIndex::nearest(const Se3& camera_from_object) const {
  Nearest best{0, 0, -2};
  for (std::size_t s = 0; s < symmetries_.size(); ++s) {
    const Se3 equal = camera_from_object * symmetries_[s];
    const Eigen::Vector3d to_camera = (inverse(equal).translation_m - center_m_).normalized();
    Eigen::Index nearest = 0;
    const double cosine = (towards_camera_ * to_camera).maxCoeff(&nearest);
    if (cosine > best.cosine) best = {std::size_t(nearest), s, cosine};
  }
  return best;
}

}  // namespace edgescout
