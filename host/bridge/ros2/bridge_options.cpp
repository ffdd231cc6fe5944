#include "host/bridge/ros2/bridge_options.h"

namespace edgescout::ros2 {

void describe(BridgeOptions& o, OptionVisitor& visit) {
  static constexpr const char* without_camera[] = {"wait", "drop"};
  constexpr double longest_seconds = 3600;
  visit.group("ROS 2");
  visit.flag({"rectified",
              "Images are rectified: their camera is P of CameraInfo, without a lens (image_rect)",
              OptionLevel::Basic},
             o.rectified);
  visit.flag(
      {"on-request", "Detect when a request asks for it, not in every image", OptionLevel::Basic},
      o.on_request);
  visit.choice({"without-camera",
                "What becomes of images while no CameraInfo fits them. wait: the newest one waits "
                "for it; drop: all are dropped"},
               o.without_camera, without_camera);
  visit.flag({"publish-tf", "Publish a frame of each instance on tf: NAME_0, NAME_1 ..",
              OptionLevel::Basic},
             o.publish_tf);
  visit.number({"tf-seconds", "How long to wait for a transform of the image's time, s"},
               o.tf_seconds, 0.0, longest_seconds);
  static constexpr const char* depth_sources[] = {"none", "aligned", "own_camera"};
  visit.choice({"depth",
                "Depth images on the topic depth. aligned: of the same camera and size as the "
                "images; own_camera: of one with a CameraInfo beside the topic and a frame in tf",
                OptionLevel::Basic},
               o.depth, depth_sources);
  visit.number({"depth-seconds",
                "How long an image waits for its depth image, s; then it is worked on alone"},
               o.depth_wait.seconds, 0.0, longest_seconds);
  visit.number({"depth-tolerance",
                "Largest difference of the stamps of an image and its depth image, s. 0: they are "
                "equal"},
               o.depth_wait.tolerance_s, 0.0, 1.0);
  visit.number({"request-seconds", "How long a request waits for an image, s"}, o.request_seconds,
               0.0, longest_seconds);
  describe(o.depth_values, visit);
}

}  // namespace edgescout::ros2
