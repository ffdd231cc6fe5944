// Runs the detector on a batch of images. Writes each result as soon as it exists, lists failures
// and can resume.
#pragma once

#include <filesystem>
#include <optional>
#include <span>
#include <string>

#include "host/cli/batch_results.h"
#include "host/cli/inputs.h"
#include "host/cli/shard.h"
#include "host/cli/template_origin.h"
#include "host/pipeline.h"

namespace edgescout {

struct BatchOptions {
  std::filesystem::path out;
  CameraArguments camera;
  DepthArguments depth;
  bool scale_camera = false;
  bool resume = false;
  bool joint = false;  // all views of a BOP scene at once
  bool overlays = true;
  int thumbnails = TableFiles{}.thumbnails;
  std::optional<Shard> shard;  // absent: all images
  std::string version;         // of the program, for shard.json
  // Whether the given backend finds the edges, and not a thread of the processor beside it. Absent:
  // where it is hardware.
  std::optional<bool> edges_on_backend;
  double max_seconds = 0;  // of the detection in an image, with `joint` in a scene; 0: no limit
  PipelineOptions pipeline;
  std::vector<TemplateOrigin> templates;  // of the sets, for summary.json
  Settings settings;  // of the verb; a resumed batch compares them. Models and cameras are added
};

// Checks the requirements of `joint`. InputError naming the first image that has no world pose or
// is given twice: a repeated view gives no new information.
void require_joinable(std::span<const InputImage> images);

// Writes into `out`: NAME.json and NAME_overlay.png for every image, results.csv (BOP),
// summary.json and report.html. They replace those of an earlier run on these images; call
// require_no_other_results before.
//
// A bad image is listed and the batch continues. If all images are bad, the error of the last one
// is thrown and nothing is written. Any other error ends the batch: results.csv then holds the
// finished images, and summary.json also the error.
//
// With a shard only its part of `images` is worked on. shard.json is written first, which says what
// the folder has to hold. Images that are all bad are then listed as well: other shards may have
// good ones. InputError: the folder holds another shard.
//
// With `resume`, images that have a result are skipped. InputError, and nothing is written: such a
// result was made with other models, cameras, views or settings. A result of another image under
// the same name is not skipped but replaced.
BatchSummary run_batch(std::span<const InputImage> images, std::span<const TemplateSet> sets,
                       Backend& backend, const BatchOptions& options);

}  // namespace edgescout
