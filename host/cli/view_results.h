// Writes the result and the overlay of one view, for all verbs.
#pragma once

#include <filesystem>
#include <span>

#include "host/cli/batch_results.h"
#include "host/pipeline.h"

namespace edgescout {

// An image that is ready for detection or registration, and the time that this took.
struct PreparedView {
  ObjectView view;
  std::vector<StageSeconds> stages;
};

// Returns the stages of all views, one view after the other.
std::vector<StageSeconds> stages_of(std::span<const PreparedView> views);

TimeLimit limit_from_now(double max_seconds);  // 0: none

// Returns the result without objects and detections, which the verb adds.
ImageResult begin_result(const InputImage& input, const ObjectView& view, const Detections& found,
                         const Backend& backend);

// Writes NAME_overlay.png: the image with all detections. `scene` has the one view of the image.
void save_overlay(const InputImage& input, const Scene& scene,
                  std::span<const Detection> detections, const std::filesystem::path& out);

}  // namespace edgescout
