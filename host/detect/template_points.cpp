#include "host/detect/template_points.h"

#include <algorithm>

#include "host/core/thinned.h"
#include "host/register/occluders.h"
#include "kernels/thread_pool.h"

namespace edgescout {

namespace {

ModelPoint transformed(const Se3& to_from_object, const ModelPoint& p) {
  const Eigen::Vector3d position = to_from_object * Eigen::Vector3d(p.x_m, p.y_m, p.z_m),
                        tangent = to_from_object.rotation * Eigen::Vector3d(p.tx, p.ty, p.tz);
  return {float(position.x()), float(position.y()), float(position.z()),
          float(tangent.x()),  float(tangent.y()),  float(tangent.z())};
}

class TemplatePoints {
 public:
  TemplatePoints(const TemplateSet& set, std::span<const ObjectView> views, int most,
                 ThreadPool& threads)
      : occlusion_tolerance_m_(occlusion_tolerance_m(set.model)),
        views_(views),
        surface_(thinned_surface(set.model)),
        viewpoints_(set),
        threads_(threads) {
    for (const TemplateView& view : set.views) points_.push_back(thinned(view.points, most));
  }

  Grid<PointsInView> operator()(std::span<const ObjectPose> poses) const {
    Grid<PointsInView> visible(poses.size(), views_.size());
    threads_.for_each(poses.size(), [&](std::size_t p) {
      for (std::size_t v = 0; v < views_.size(); ++v) {
        visible(p, v).edges = visible_in(views_[v], poses[p].world_from_object);
        if (views_[v].depth_values) visible(p, v).surface = surface_;
      }
    });
    return visible;
  }

 private:
  std::vector<ModelPoint> visible_in(const ObjectView& view, const Se3& world_from_object) const {
    const Se3 camera_from_object = view.camera_from_world * world_from_object;
    const ViewpointIndex::Nearest nearest = viewpoints_.nearest(camera_from_object);
    const Se3& symmetry = viewpoints_.symmetry(nearest.symmetry);
    std::vector<ModelPoint> points;
    for (const ModelPoint& point : points_[nearest.viewpoint])
      points.push_back(transformed(symmetry, point));
    if (view.occluders)
      remove_hidden(points, *view.occluders, camera_from_object, occlusion_tolerance_m_);
    return points;
  }

  // A beginning of the samples is spread evenly (sample_surface). Half of them face away.
  static std::vector<SurfacePoint> thinned_surface(const EdgeModel& model) {
    constexpr std::size_t most = 120;
    const std::vector<SurfacePoint>& all = model.surface_points;
    return {all.begin(), all.begin() + std::ptrdiff_t(std::min(most, all.size()))};
  }

  double occlusion_tolerance_m_;
  std::span<const ObjectView> views_;
  std::vector<SurfacePoint> surface_;
  ViewpointIndex viewpoints_;
  std::vector<std::vector<ModelPoint>> points_;  // by viewpoint, thinned
  ThreadPool& threads_;
};

}  // namespace

PointsInViews template_points(const TemplateSet& set, std::span<const ObjectView> views, int most,
                              Backend& backend) {
  return TemplatePoints(set, views, most, backend.threads());
}

}  // namespace edgescout
