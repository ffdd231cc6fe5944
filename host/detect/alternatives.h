// Other poses of a detected object that the images hardly tell from the detected one, such as half
// a turn of a part whose two ends look alike in this view.
#pragma once

#include <span>

#include "host/model/template_set.h"
#include "host/register/pose_estimate.h"

namespace edgescout {

// Its centre lies within this fraction of the diameter of the detection's centre, ..
inline constexpr double ALTERNATIVE_CENTER = 0.25;
// .. one corner of its box at least this fraction from where the detection has it (modulo symmetry,
// pose_distance_m), ..
inline constexpr double ALTERNATIVE_APART = 0.2;
// .. and its probability is at least this fraction of the detection's.
inline constexpr double ALTERNATIVE_PROBABILITY = 0.25;

// Sets the alternatives of every detection: those among the poses that competed (SelectionTrace),
// most probable first, as far apart from each other as from the detection. Poses are in one frame;
// the poses have features. `sets` is by object.
void set_alternatives(std::span<Detection> detections, std::span<const PoseEstimate> competing,
                      std::span<const TemplateSet> sets);

}  // namespace edgescout
