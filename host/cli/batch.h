// A batch of images on its way through the detector: results on disk as soon as they exist,
// failures listed, nothing done twice.
#pragma once

#include <filesystem>
#include <span>
#include <string>

#include "host/cli/batch_results.h"
#include "host/pipeline.h"

namespace edgescout {

struct BatchOptions {
  std::filesystem::path out;
  std::string camera_file;  // empty: BOP scenes bring their own
  bool scale_camera = false;
  bool resume = false;
  bool joint = false;  // all views of a BOP scene at once
  bool overlays = true;
  PipelineOptions pipeline;
  Settings settings;  // of the verb, for a resumed batch to compare; models and cameras are added
};

// What `joint` asks for. InputError naming the first image without a world pose or given twice: the
// same view again is no evidence of its own.
void require_joinable(std::span<const InputImage> images);

// Writes into `out`: NAME.json and NAME_overlay.png an image, results.csv (BOP) and summary.json,
// in place of those of an earlier run on these images: whoever calls has asked
// require_no_other_results. A bad image is listed and the batch goes on; where all are bad the last
// one's error is thrown and nothing is written. Any other error ends the batch; results.csv holds
// what was finished and summary.json the error too. With `resume` images whose result is there are
// skipped; InputError, and nothing is written, where one of these was made with other models,
// cameras, views or settings. Another image's result of the same name is none of these.
BatchSummary run_batch(std::span<const InputImage> images, std::span<const TemplateSet> sets,
                       Backend& backend, const BatchOptions& options);

}  // namespace edgescout
