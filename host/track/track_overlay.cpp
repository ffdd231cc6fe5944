#include "host/track/track_overlay.h"

#include "host/io/image.h"

namespace edgescout {

RgbImage draw_tracks(const Image& image, const Camera& camera, std::span<const Track> tracks,
                     std::span<const EdgeModel> models, Backend& backend) {
  std::vector<OverlayPose> poses;
  for (const Track& track : tracks)
    if (track.state != TrackState::Lost)
      poses.push_back({track.object, track.world_from_object, track.above_chance,
                       std::to_string(track.id) + " " + to_string(track.state)});
  return draw_overlay(undistort(image, camera), undistorted(camera), poses, models, nullptr,
                      backend);
}

}  // namespace edgescout
