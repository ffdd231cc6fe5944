#include "host/register/visible_in_views.h"

#include "host/register/occluders.h"
#include "kernels/error.h"

namespace edgescout {

std::vector<VisibleInView> visible_in_views(std::span<const EdgeModel> models,
                                            std::span<const ObjectPose> poses,
                                            std::span<const RegisterView> views, Backend& backend,
                                            const VisibilityOptions& visibility) {
  for (const ObjectPose& pose : poses)
    check(pose.object >= 0 && std::size_t(pose.object) < models.size(),
          "visible_in_views: no such model");
  std::vector<VisibleInView> seen(poses.size() * views.size());
  for (std::size_t object = 0; object < models.size(); ++object) {
    const EdgeModel& model = models[object];
    std::vector<Se3> camera_from_object;
    std::vector<std::size_t> slots;
    for (std::size_t p = 0; p < poses.size(); ++p)
      for (std::size_t v = 0; poses[p].object == int(object) && v < views.size(); ++v) {
        camera_from_object.push_back(views[v].camera_from_world * poses[p].world_from_object);
        slots.push_back(p * views.size() + v);
      }
    std::vector<std::vector<ModelPoint>> visible =
        visible_edges(model, camera_from_object, backend, visibility);
    for (std::size_t i = 0; i < slots.size(); ++i) {
      VisibleInView& slot = seen[slots[i]];
      slot.points = std::move(visible[i]);
      slot.unoccluded = slot.points.size();
      if (const Occluders* occluders = views[slots[i] % views.size()].occluders.get())
        remove_hidden(slot.points, *occluders, camera_from_object[i], occlusion_tolerance_m(model));
    }
  }
  return seen;
}

}  // namespace edgescout
