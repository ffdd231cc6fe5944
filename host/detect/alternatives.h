// Other poses of a detected object that the images hardly tell from the detected one, such as half
// a turn of a part whose two ends look alike in this view.
#pragma once

#include <span>

#include "host/model/template_set.h"
#include "host/register/pose_estimate.h"

namespace edgescout {

// An alternative is at least this fraction as probable as the detection.
inline constexpr double ALTERNATIVE_PROBABILITY = 0.25;

// Sets the alternatives of every detection: those among the poses that competed (SelectionTrace),
// most probable first. Their centres lie within thresholds::ALTERNATIVE_CENTER of the detection's
// centre, and they are apart from it and from each other by thresholds::ALTERNATIVE_APART. Poses
// are in one frame; the poses have features. `sets` is by object.
void set_alternatives(std::span<Detection> detections, std::span<const PoseEstimate> competing,
                      std::span<const TemplateSet> sets);

// At most one of a detection and its alternatives is right. So they share their odds: those of each
// are multiplied by its part of the sum of all their odds. Of two poses with odds of 1 each has
// odds of 1/2 then. (docs/research/probability.md)
void share_odds(Detection& detection);

}  // namespace edgescout
