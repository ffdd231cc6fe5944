#include "host/baselines/visible_points.h"

#include "kernels/error.h"

namespace edgescout {

std::vector<std::vector<ModelPoint>> visible_points(std::span<const EdgeModel> models,
                                                    std::span<const int> objects,
                                                    std::span<const Se3> camera_from_object, Backend& backend,
                                                    const VisibilityOptions& visibility) {
  for (const int object : objects)
    check(object >= 0 && object < int(models.size()), "visible_points: no such model");
  std::vector<std::vector<ModelPoint>> points(objects.size());
  for (int object = 0; object < int(models.size()); ++object) {
    std::vector<Se3> poses;
    std::vector<std::size_t> slots;
    for (std::size_t i = 0; i < objects.size(); ++i)
      if (objects[i] == object) {
        poses.push_back(camera_from_object[i]);
        slots.push_back(i);
      }
    std::vector<std::vector<ModelPoint>> visible = visible_edges(models[object], poses, backend, visibility);
    for (std::size_t i = 0; i < slots.size(); ++i) points[slots[i]] = std::move(visible[i]);
  }
  return points;
}

}  // namespace edgescout
