// Candidates of several calibrated views of one static scene, refined over all of them.
#pragma once

#include "host/detect/select_detections.h"

namespace edgescout {

// `candidates` by view and object, in the views' camera frames. Every candidate is carried to the
// world, duplicates are merged, the best (as many as four views may have) are registered on the
// tensors of all views at once (Eq. 11), and they are decided over all views.
std::vector<Detection> join_views(std::span<const TemplateSet> sets,
                                  std::span<const EdgeModel> models,
                                  std::span<const std::vector<std::vector<Refined>>> candidates,
                                  std::span<const Observation> observations, Backend& backend,
                                  const DetectOptions& options);

}  // namespace edgescout
