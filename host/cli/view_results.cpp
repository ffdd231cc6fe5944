#include "host/cli/view_results.h"

#include "host/io/image.h"
#include "host/io/overlay.h"

namespace edgescout {

ImageResult begin_result(const InputImage& input, const PreparedImage& prepared,
                         const Detections& found, const Backend& backend) {
  ImageResult result;
  result.image = place_of(input);
  result.scene_id = input.scene_id;
  result.image_id = input.image_id;
  result.camera = prepared.camera;
  result.device = backend.name();
  result.stages = found.stages;
  result.camera_from_world = input.camera_from_world;
  return result;
}

void save_overlay(const InputImage& input, const PreparedImage& prepared, const Detections& found,
                  std::span<const EdgeModel> models, Backend& backend,
                  const std::filesystem::path& out) {
  std::vector<OverlayPose> poses;
  for (const Detection& d : found.detections)
    poses.push_back({d.object, prepared.camera_from_world * d.world_from_object, d.probability,
                     models[static_cast<std::size_t>(d.object)].mesh.name});
  const EdgeIndex edges(prepared.edges, prepared.camera.width, prepared.camera.height);
  save_png(draw_overlay(prepared.image, prepared.camera, poses, models, &edges, backend),
           overlay_of(out, input));
}

}  // namespace edgescout
