// A camera beside the program: its images, calibrations and places, and what the program sends.
#pragma once

#include <optional>

#include "tests/bridge/dds/dds_peer.h"
#include "tests/bridge/small_world.h"
#include "tests/cli/example_scene.h"

namespace edgescout::ros2::test {

using edgescout::test::joined;
using edgescout::test::part_file;

// The options of SmallWorld.
inline std::vector<std::string> bracket(const std::vector<std::string>& more = {}) {
  return joined({{"--model",           part_file(1), "--unit",         "mm",
                  "--device",          "cpu",        "--viewpoints",   "3",
                  "--in-plane-steps",  "12",         "--distance-min", "0.27",
                  "--distance-max",    "0.33",       "--coarse-poses", "150",
                  "--medium-poses",    "30",         "--candidates",   "10",
                  "--min-probability", "0.01"},
                 more});
}

struct CameraPeer : Peer {
  DdsWriter image = writer<sensor_msgs_msg_dds__Image_>("rt/image", {.is_reliable = false}),
            info =
                writer<sensor_msgs_msg_dds__CameraInfo_>("rt/camera_info", {.is_reliable = false}),
            depth = writer<sensor_msgs_msg_dds__Image_>("rt/depth", {.is_reliable = false}),
            tf = writer<tf2_msgs_msg_dds__TFMessage_>("rt/tf", {});
  std::vector<msg::Detection3DArray> detections;
  std::optional<msg::DiagnosticStatus> status;
  std::size_t view = 0;  // of SmallWorld: where the camera stands
  bool sends_depth = false;

  CameraPeer() {
    subscribe<vision_msgs_msg_dds__Detection3DArray_>(
        "rt/edgescout/detections", {},
        [this](const auto& wire) { detections.push_back(plain_of<msg::Detection3DArray>(wire)); });
    subscribe<diagnostic_msgs_msg_dds__DiagnosticArray_>(
        "rt/diagnostics", {},
        [this](const auto& wire) { status = plain_of<msg::DiagnosticArray>(wire).status.at(0); });
  }
  void send() {
    const double now = ++seconds_;
    const Se3 world_from_camera = inverse(small_world().camera_from_world(view));
    write<tf2_msgs_msg_dds__TFMessage_>(
        tf, msg::TFMessage{{transform_message("world", "camera", world_from_camera, now)}});
    write<sensor_msgs_msg_dds__CameraInfo_>(info, info_message(small_world().camera(), now));
    write<sensor_msgs_msg_dds__Image_>(image, image_message(small_world().image(view), now));
    if (sends_depth) write<sensor_msgs_msg_dds__Image_>(depth, depth_message(now, view));
  }
  std::string diagnostics() const {
    std::string text = status ? status->message : "no diagnostics";
    if (status)
      for (const msg::KeyValue& value : status->values)
        text += "\n  " + value.key + ": " + value.value;
    return text + "\n";
  }
  // Sends images until one is answered.
  bool send_until(const std::function<bool()>& condition, double seconds = 30) {
    auto next = std::chrono::steady_clock::now();
    return spin_until(
        [&] {
          if (std::chrono::steady_clock::now() > next) {
            next += std::chrono::milliseconds(200);
            send();
          }
          return condition();
        },
        seconds);
  }

 private:
  double seconds_ = 0;
};

}  // namespace edgescout::ros2::test
