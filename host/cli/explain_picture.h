// Draws a given pose and the one that took its place over the image.
#pragma once

#include "host/detect/explain.h"
#include "host/io/image.h"

namespace edgescout {

// Returns the surroundings of both poses, small ones enlarged up to four times. Edges of the given
// pose are green where the image has one near and orange elsewhere (overlay.h); those of the other
// pose are cyan. `scene` has the one view of the image.
RgbImage explain_picture(const Scene& scene, const ObjectPose& given,
                         const std::optional<Rival>& rival);

}  // namespace edgescout
