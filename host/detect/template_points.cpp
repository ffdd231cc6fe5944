#include "host/detect/template_points.h"

#include "host/register/occluders.h"
#include "kernels/thread_pool.h"

namespace edgescout {

namespace {

ModelPoint moved(const Se3& to_from_object, const ModelPoint& p) {
  const Eigen::Vector3d at = to_from_object * Eigen::Vector3d(p.x_m, p.y_m, p.z_m),
                        along = to_from_object.rotation * Eigen::Vector3d(p.tx, p.ty, p.tz);
  return {float(at.x()),    float(at.y()),    float(at.z()),
          float(along.x()), float(along.y()), float(along.z())};
}

class Lookup {
 public:
  Lookup(const TemplateSet& set, std::span<const RegisterView> views, int most, ThreadPool& threads)
      : tolerance_m_(occlusion_tolerance_m(set.model)),
        views_(views),
        nearest_(set),
        threads_(threads) {
    for (const TemplateView& view : set.views) points_.push_back(thinned(view.points, most));
  }
  std::vector<std::vector<ModelPoint>> operator()(std::span<const ObjectPose> poses) const {
    std::vector<std::vector<ModelPoint>> seen(poses.size() * views_.size());
    threads_.for_each(poses.size(), [&](std::size_t p) {
      for (std::size_t v = 0; v < views_.size(); ++v)
        seen[p * views_.size() + v] = seen_by(views_[v], poses[p].world_from_object);
    });
    return seen;
  }

 private:
  std::vector<ModelPoint> seen_by(const RegisterView& view, const Se3& world_from_object) const {
    const Se3 camera_from_object = view.camera_from_world * world_from_object;
    const auto [viewpoint, symmetry] = nearest_.of(camera_from_object);
    std::vector<ModelPoint> points;
    for (const ModelPoint& point : points_[viewpoint]) points.push_back(moved(*symmetry, point));
    if (view.occluders) remove_hidden(points, *view.occluders, camera_from_object, tolerance_m_);
    return points;
  }

  double tolerance_m_;
  std::span<const RegisterView> views_;
  NearestViewpoint nearest_;
  std::vector<std::vector<ModelPoint>> points_;
  ThreadPool& threads_;
};

}  // namespace

PointsInViews template_points(const TemplateSet& set, std::span<const RegisterView> views, int most,
                              Backend& backend) {
  return Lookup(set, views, most, backend.threads());
}

}  // namespace edgescout
