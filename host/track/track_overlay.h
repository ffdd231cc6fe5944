// Draws what a tracker follows over an image.
//
// Public header.
#pragma once

#include <span>

#include "host/overlay.h"
#include "host/track/tracker.h"

namespace edgescout {

// Returns the undistorted image with the edges and axes of what is tracked or doubtful
// (draw_overlay), each with its id, its state and Track::above_chance. `camera` is that of the
// image, with its lens.
RgbImage draw_tracks(const Image& image, const Camera& camera, std::span<const Track> tracks,
                     std::span<const EdgeModel> models, Backend& backend);

}  // namespace edgescout
