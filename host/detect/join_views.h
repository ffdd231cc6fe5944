// Refines the candidates of several calibrated views of one static scene over all views.
#pragma once

#include "host/core/grid.h"
#include "host/detect/select_detections.h"

namespace edgescout {

// `candidates`: rows are views, columns are objects; poses are in the camera frames of the views.
// Every candidate is transformed to the world and duplicates are merged. The most probable ones
// (four times DetectOptions::candidates) are registered on the tensors of all views at once (Eq.
// 11) and selected over all views. `trace`, where given, receives the selection.
std::vector<Detection> join_views(const Scene& scene, std::span<const TemplateSet> sets,
                                  const Grid<std::vector<PoseEstimate>>& candidates,
                                  const DetectOptions& options, SelectionTrace* trace = nullptr);

}  // namespace edgescout
