// What the bridge is told besides models and device.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "host/active/scout_options.h"
#include "host/bridge/ros2/depth_matches.h"
#include "host/core/camera.h"
#include "host/core/options.h"
#include "host/io/depth_options.h"
#include "host/io/image_options.h"
#include "host/pipeline.h"

namespace edgescout::ros2 {

enum class WithoutCamera { Wait, Drop };
// Depth images: none, of the camera of the images, or of one with a CameraInfo and a frame of its
// own.
enum class DepthSource { None, Aligned, OwnCamera };

struct BridgeOptions {
  std::string node = "edgescout";
  PipelineOptions pipeline;
  ImageOptions images;
  double max_seconds = 0;        // of each image; 0: no limit
  std::optional<Camera> camera;  // in place of CameraInfo
  std::string camera_file;       // where it stands
  double field_of_view_rad = 0;
  bool scale_camera = false;
  ScoutOptions scout;
  std::vector<Se3> scout_views;  // camera_from_world
  // Those below are described.
  bool rectified = false;
  bool on_request = false;
  WithoutCamera without_camera = WithoutCamera::Wait;
  DepthSource depth = DepthSource::None;
  DepthWait depth_wait;
  DepthOptions depth_values;
  bool publish_tf = false;
  double tf_seconds = 0.2;
  double request_seconds = 5;
  std::string world_frame;  // empty: poses are in the frame of the image
};

void describe(BridgeOptions& options, OptionVisitor& visit);

}  // namespace edgescout::ros2
