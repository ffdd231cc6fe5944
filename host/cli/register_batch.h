// Start poses on their way through the registration, one image or one scene of views at a time:
// results on disk as soon as they exist.
#pragma once

#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "host/cli/batch_results.h"
#include "host/io/poses.h"
#include "host/pipeline.h"

namespace edgescout {

struct RegisterOptions {
  std::filesystem::path out;
  std::optional<Camera> camera;  // absent: BOP scenes bring their own
  std::string camera_file;
  bool scale_camera = false;
  bool resume = false;
  bool overlays = true;
  PipelineOptions pipeline;  // edges and tensor of it
  RefineOptions refine;
  Settings settings;  // see BatchOptions; models, cameras and starts are added
};

struct RegisterModel {
  int object_id = 1;
  EdgeModel edges;
};

// What is registered together: the views, and the starts with the view that each was given in. One
// view: its camera frame is the world. Several: all must have a world pose.
struct RegisterJob {
  std::vector<InputImage> views;
  struct Start {
    std::size_t view;
    int model;  // index
    Se3 camera_from_object;
  };
  std::vector<Start> starts;
};

// One job an image, or a BOP scene with `multi_view`, in the order of the images; images without
// starts are left out of single views. `poses_file` appears in errors. InputError: a start for an
// image or an object that is not there, for more than one image, or with its object behind the
// camera; no start that fits the images' scenes; a view without world pose. Starts of other scenes
// are passed over.
std::vector<RegisterJob> make_jobs(std::span<const InputImage> images,
                                   std::span<const RegisterModel> models,
                                   std::span<const StartPose> poses, bool multi_view,
                                   const std::string& poses_file);

struct RegisterSummary : BatchSummary {  // images: those with starts
  int refined = 0;                       // poses, now
};

// Writes into `out`: NAME.json for every image with starts, its detections in the order of the
// starts; NAME_overlay.png of every view; and at the end, also one by any other error, results.csv
// with one row a start and summary.json; of earlier results as run_batch. A pose that no image
// shows gets probability 0 and OUT_OF_SIGHT, and is warned of. A job with a bad image is listed and
// the batch goes on. Where all jobs fail the last one's error is thrown and nothing is written.
// With `resume`, jobs whose results are there are skipped; InputError, and nothing is written,
// where one of these was made with other models, cameras, views, starts or settings. Another
// image's result of the same name is none of these.
RegisterSummary run_register(std::span<const RegisterJob> jobs,
                             std::span<const RegisterModel> models, Backend& backend,
                             const RegisterOptions& options);

}  // namespace edgescout
