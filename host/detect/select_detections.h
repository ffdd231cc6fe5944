// From registered candidates to detections: what can exist together, looked at once more.
#pragma once

#include <span>
#include <vector>

#include "host/detect/detect.h"

namespace edgescout {

// Candidates of all objects in the frame of `views` (the camera of one view, or the world),
// refined. Keeps the probable ones, lets them compete for the image's edges (evidence.h), searches
// once more around the winners (a wrong local optimum loses to the right one near it), and lets all
// compete again. Best probability first.
std::vector<Detection> select_detections(std::span<const EdgeModel> models,
                                         std::span<const ObjectPose> poses,
                                         std::span<const Refined> refined,
                                         std::span<const RegisterView> views, Backend& backend,
                                         const DetectOptions& options);

}  // namespace edgescout
