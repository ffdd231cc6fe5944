#include "host/register/coarse_registration.h"

#include "kernels/error.h"

namespace edgescout {

std::size_t level_of_pose(const ObjectView& view, const EdgeModel& model,
                          const Se3& camera_from_object) {
  const double distance_m = (camera_from_object * model.center_m).norm();
  return level_for(size_px(model.mesh.diameter_m, distance_m, view.camera), view);
}

std::vector<PoseEstimate> register_coarsely(const Scene& scene, std::span<const ObjectPose> starts,
                                            const RegisterOnLevel& register_on_level) {
  check(!scene.views.empty(), "register_coarsely: at least one view");
  const ObjectView& view = scene.views[0];
  std::vector<std::vector<std::size_t>> by_level(std::max<std::size_t>(1, view.reduced.size()));
  for (std::size_t i = 0; i < starts.size(); ++i)
    by_level[level_of_pose(view, scene.models[std::size_t(starts[i].object)],
                           view.camera_from_world * starts[i].world_from_object)]
        .push_back(i);
  std::vector<PoseEstimate> estimates(starts.size());
  for (std::size_t level = 0; level < by_level.size(); ++level) {
    const std::vector<std::size_t>& indices = by_level[level];
    if (indices.empty()) continue;
    std::vector<ObjectPose> poses;
    for (const std::size_t i : indices) poses.push_back(starts[i]);
    const std::vector<ObjectView> views = on_coarse_tensors(scene.views, level);
    std::vector<PoseEstimate> registered =
        register_on_level({scene.models, views, scene.backend, scene.limit}, poses);
    for (std::size_t k = 0; k < indices.size(); ++k)
      estimates[indices[k]] = std::move(registered[k]);
  }
  return estimates;
}

std::vector<PoseEstimate> register_coarsely(const Scene& scene, std::span<const ObjectPose> starts,
                                            const D2coOptions& options) {
  return register_coarsely(scene, starts,
                           [&](const Scene& on_level, std::span<const ObjectPose> poses) {
                             return register_poses(on_level, poses, options);
                           });
}

std::vector<PoseEstimate> register_coarsely(const Scene& scene, const TemplateSet& set,
                                            std::span<const ObjectPose> starts,
                                            const D2coOptions& options) {
  return register_coarsely(scene, starts,
                           [&](const Scene& on_level, std::span<const ObjectPose> poses) {
                             return register_on_templates(on_level, set, poses, options);
                           });
}

}  // namespace edgescout
