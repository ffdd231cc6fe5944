// Follows objects through sequences of images: videos, folders, BOP scenes.
#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "host/cli/inputs.h"
#include "host/cli/register_batch.h"
#include "host/track/tracker.h"

namespace edgescout {

struct TrackRequest {
  std::filesystem::path out;
  CameraArguments calibration;
  bool scale_camera = false;
  bool overlays = true;
  bool search = true;      // for objects that are lost or not yet found
  int search_every = 15;   // frames
  double max_seconds = 0;  // of each search; 0: no limit
  double frame_rate = 0;   // Hz; 0: as a video's header says, else 30
  DepthArguments depth;
  TrackOptions tracking;
};

struct TrackSummary {
  int frames = 0, sequences = 0;
  int instances = 0, losses = 0;  // an instance that becomes lost counts once more each time
  int tracked = 0, doubtful = 0, lost = 0;  // rows of tracks.csv
  std::vector<double> update_ms;            // of each frame
  std::vector<std::string> failures;        // images that could not be read: one line each
  double seconds = 0;
};

// Each BOP scene, each camera of one, each video and the remaining images are one sequence with a
// tracker of its own. `starts` are poses in images of the sequences: an object is followed from its
// image on. Writes into the folder:
//   tracks.csv        a row for every instance in every frame, as soon as the frame is done
//   NAME_overlay.png  every frame with what is tracked or doubtful
//   results.csv       BOP results of what is tracked or doubtful; score: Track::above_chance
//   summary.json
// A bad image is listed and its sequence goes on with the next one. InputError: no image can be
// used; a folder that cannot be written.
TrackSummary run_track(std::span<const InputImage> images, std::span<const TemplateSet> sets,
                       std::span<const RegisterJob> starts, Backend& backend,
                       const TrackRequest& request);

}  // namespace edgescout
