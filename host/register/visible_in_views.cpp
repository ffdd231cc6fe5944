#include "host/register/visible_in_views.h"

#include <algorithm>
#include <utility>

#include "host/register/occluders.h"
#include "kernels/error.h"

namespace edgescout {

namespace {

struct PoseInView {
  std::size_t pose, view;
};

struct Visibility {
  VisibilityOptions options;
  bool with_marks;
};

// The cells of one object's poses.
void fill_object(Grid<VisibleInView>& visible, const Scene& scene,
                 std::span<const ObjectPose> poses, std::size_t object,
                 const Visibility& visibility) {
  const EdgeModel& model = scene.models[object];
  std::vector<Se3> camera_from_object;
  std::vector<PoseInView> cells;
  for (std::size_t p = 0; p < poses.size(); ++p)
    for (std::size_t v = 0; poses[p].object == int(object) && v < scene.views.size(); ++v) {
      camera_from_object.push_back(scene.views[v].camera_from_world * poses[p].world_from_object);
      cells.push_back({p, v});
    }
  std::vector<SilhouetteMarks> marks;
  VisibleSurfaces surfaces;
  std::vector<std::vector<ModelPoint>> points = visible_edges(
      model, camera_from_object, scene.backend, visibility.options,
      visibility.with_marks ? &marks : nullptr, scene.has_depth() ? &surfaces : nullptr);
  for (std::size_t i = 0; i < cells.size(); ++i) {
    VisibleInView& cell = visible(cells[i].pose, cells[i].view);
    cell.points = std::move(points[i]);
    if (visibility.with_marks) cell.on_silhouette = std::move(marks[i]);
    cell.unoccluded = cell.points.size();
    if (scene.views[cells[i].view].depth_values) cell.surface = std::move(surfaces[i]);
    if (const Occluders* occluders = scene.views[cells[i].view].occluders.get())
      remove_hidden(cell.points, *occluders, camera_from_object[i], occlusion_tolerance_m(model),
                    visibility.with_marks ? &cell.on_silhouette : nullptr);
  }
}

Grid<VisibleInView> fill_all(const Scene& scene, std::span<const ObjectPose> poses,
                             const Visibility& visibility) {
  for (const ObjectPose& pose : poses)
    check(pose.object >= 0 && std::size_t(pose.object) < scene.models.size(),
          "visible_in_views: no such model");
  Grid<VisibleInView> visible(poses.size(), scene.views.size());
  for (std::size_t object = 0; object < scene.models.size(); ++object)
    fill_object(visible, scene, poses, object, visibility);
  return visible;
}

}  // namespace

Grid<VisibleInView> visible_in_views(const Scene& scene, std::span<const ObjectPose> poses,
                                     const VisibilityOptions& visibility) {
  return fill_all(scene, poses, {visibility, false});
}

Grid<VisibleInView> marked_in_views(const Scene& scene, std::span<const ObjectPose> poses,
                                    const VisibilityOptions& visibility) {
  return fill_all(scene, poses, {visibility, true});
}

Grid<std::vector<ModelPoint>> visible_points(const Scene& scene, std::span<const ObjectPose> poses,
                                             const VisibilityOptions& visibility) {
  Grid<VisibleInView> visible = visible_in_views(scene, poses, visibility);
  Grid<std::vector<ModelPoint>> points(visible.rows(), visible.columns());
  for (std::size_t i = 0; i < visible.values().size(); ++i)
    points.values()[i] = std::move(visible.values()[i].points);
  return points;
}

}  // namespace edgescout
