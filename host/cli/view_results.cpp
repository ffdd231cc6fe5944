#include "host/cli/view_results.h"

#include "host/io/thumbnail.h"
#include "host/overlay.h"

namespace edgescout {

std::vector<StageSeconds> stages_of(std::span<const PreparedView> views) {
  std::vector<StageSeconds> stages;
  for (const PreparedView& view : views)
    stages.insert(stages.end(), view.stages.begin(), view.stages.end());
  return stages;
}

TimeLimit limit_from_now(double max_seconds) {
  return max_seconds > 0 ? TimeLimit::after(max_seconds) : TimeLimit{};
}

ImageResult begin_result(const InputImage& input, const ObjectView& view, const Detections& found,
                         const Backend& backend) {
  ImageResult result;
  result.image = place_of(input);
  result.scene_id = input.scene_id;
  result.image_id = input.image_id;
  result.camera_name = input.camera_name;
  result.camera = view.camera;
  result.device = backend.name();
  if (found.completion != Completion::Complete) result.incomplete = to_string(found.completion);
  result.stages = found.stages;
  result.camera_from_world = input.camera_from_world;
  return result;
}

void save_overlay(const InputImage& input, const Scene& scene,
                  std::span<const Detection> detections, const std::filesystem::path& out) {
  const ObjectView& view = scene.views[0];
  std::vector<OverlayPose> poses;
  for (const Detection& d : detections)
    poses.push_back({d.object, view.camera_from_world * d.world_from_object, d.probability,
                     scene.models[static_cast<std::size_t>(d.object)].mesh.name});
  save_png_with_thumbnail(
      draw_overlay(*view.image, view.camera, poses, scene.models, view.edges.get(), scene.backend),
      overlay_of(out, input));
}

}  // namespace edgescout
