// Runs the registration of start poses, one image or one scene of views at a time. Writes each
// result as soon as it exists.
#pragma once

#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "host/cli/batch_results.h"
#include "host/cli/shard.h"
#include "host/io/poses.h"
#include "host/pipeline.h"

namespace edgescout {

struct RegisterOptions {
  std::filesystem::path out;
  std::optional<Camera> camera;  // absent: the camera of the BOP scene
  CameraArguments calibration;   // from which `camera` is read
  DepthArguments depth;
  bool scale_camera = false;
  bool resume = false;
  bool overlays = true;
  int thumbnails = TableFiles{}.thumbnails;
  std::optional<Shard> shard;  // as in BatchOptions
  std::string version;
  double max_seconds = 0;    // of each registration; 0: no limit
  PipelineOptions pipeline;  // only its edges and tensor are used
  RefineOptions refine;
  Settings settings;  // of the verb, as in BatchOptions; models, cameras and starts are added
};

struct RegisterModel {
  int object_id = 1;
  EdgeModel edges;
};

// One registration: the views, and the starts with the view in which each was given. With one view
// its camera frame is the world. With several views all must have a world pose.
struct RegisterJob {
  std::vector<InputImage> views;
  struct Start {
    std::size_t view;
    int model;  // index
    Se3 camera_from_object;
  };
  std::vector<Start> starts;
};

// Makes one job per image, or with `multi_view` one per BOP scene, in the order of the images. Jobs
// without starts are left out. Starts of other scenes are ignored. `poses_file` appears in errors.
// InputError: a start for an image or an object that is not given, for more than one image, or with
// its object behind the camera; no start for the scenes of the images; a view without world pose in
// a job of several views.
std::vector<RegisterJob> make_jobs(std::span<const InputImage> images,
                                   std::span<const RegisterModel> models,
                                   std::span<const StartPose> poses, bool multi_view,
                                   const std::string& poses_file);

struct RegisterSummary : BatchSummary {  // images: those with starts
  int refined = 0;                       // poses refined in this run
};

// Writes into `out`: NAME.json for every image with starts, with its detections in the order of the
// starts; NAME_overlay.png for every view; at the end results.csv, with one row per start,
// summary.json and report.html. With a shard: its part of the jobs alone, as run_batch does.
// Earlier results are handled as in run_batch. A pose that no image shows gets probability 0 and
// OUT_OF_SIGHT, and a warning is logged.
//
// A job with a bad image is listed and the batch continues. If all jobs fail, the error of the last
// one is thrown and nothing is written. Any other error ends the batch; results.csv and
// summary.json are written all the same.
//
// With `resume`, jobs that have results are skipped. InputError, and nothing is written: such a
// result was made with other models, cameras, views, starts or settings. A result of another image
// under the same name is not skipped but replaced.
RegisterSummary run_register(std::span<const RegisterJob> all_jobs,
                             std::span<const RegisterModel> models, Backend& backend,
                             const RegisterOptions& options);

}  // namespace edgescout
