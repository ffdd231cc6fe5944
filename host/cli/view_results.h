// What is written of one view, by whichever verb worked on it: its result and its overlay.
#pragma once

#include <filesystem>
#include <span>

#include "host/cli/batch_results.h"
#include "host/detect/detect.h"

namespace edgescout {

// All but objects and detections: which of these are the view's, the verb knows.
ImageResult begin_result(const InputImage& input, const PreparedImage& prepared,
                         const Detections& found, const Backend& backend);

// NAME_overlay.png: the image with all that was found.
void save_overlay(const InputImage& input, const PreparedImage& prepared, const Detections& found,
                  std::span<const EdgeModel> models, Backend& backend,
                  const std::filesystem::path& out);

}  // namespace edgescout
