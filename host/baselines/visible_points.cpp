#include "host/baselines/visible_points.h"

#include <utility>

#include "host/register/visible_in_views.h"

namespace edgescout {

std::vector<std::vector<ModelPoint>> visible_points(std::span<const EdgeModel> models,
                                                    std::span<const ObjectPose> hypotheses,
                                                    std::span<const RegisterView> views,
                                                    Backend& backend,
                                                    const VisibilityOptions& visibility) {
  std::vector<std::vector<ModelPoint>> points;
  for (VisibleInView& seen : visible_in_views(models, hypotheses, views, backend, visibility))
    points.push_back(std::move(seen.points));
  return points;
}

std::vector<std::vector<ModelPoint>> visible_points(std::span<const EdgeModel> models,
                                                    std::span<const Candidate> candidates,
                                                    const RegisterView& view, Backend& backend,
                                                    const VisibilityOptions& visibility) {
  RegisterView in_its_frame = view;
  in_its_frame.camera_from_world = {};
  std::vector<ObjectPose> poses;
  for (const Candidate& candidate : candidates)
    poses.push_back({candidate.object, candidate.camera_from_object});
  return visible_points(models, poses, {&in_its_frame, 1}, backend, visibility);
}

}  // namespace edgescout
