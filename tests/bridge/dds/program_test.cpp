// The program beside a peer on DDS.
#include <gtest/gtest.h>

#include <optional>

#include "tests/bridge/dds/dds_peer.h"
#include "tests/bridge/small_world.h"
#include "tests/cli/example_scene.h"

namespace edgescout::ros2::test {

namespace {

using edgescout::test::joined;
using edgescout::test::part_file;

std::vector<std::string> bracket(const std::vector<std::string>& more = {}) {
  return joined({{"--model", part_file(1), "--unit", "mm", "--device", "cpu", "--viewpoints", "3",
                  "--in-plane-steps", "12", "--distance-min", "0.27", "--distance-max", "0.33",
                  "--coarse-poses", "600", "--min-probability", "0.1"},
                 more});
}

// A camera on DDS, and what the program sends.
struct CameraPeer : Peer {
  DdsWriter image = writer<sensor_msgs_msg_dds__Image_>("rt/image", {.is_reliable = false}),
            info = writer<sensor_msgs_msg_dds__CameraInfo_>("rt/camera_info",
                                                            {.is_reliable = false});
  std::vector<msg::Detection3DArray> detections;
  std::optional<msg::DiagnosticStatus> status;

  CameraPeer() {
    subscribe<vision_msgs_msg_dds__Detection3DArray_>(
        "rt/edgescout/detections", {},
        [this](const auto& wire) { detections.push_back(plain_of<msg::Detection3DArray>(wire)); });
    subscribe<diagnostic_msgs_msg_dds__DiagnosticArray_>(
        "rt/diagnostics", {},
        [this](const auto& wire) { status = plain_of<msg::DiagnosticArray>(wire).status.at(0); });
  }
  void send(double seconds) {
    write<sensor_msgs_msg_dds__CameraInfo_>(info,
                                            info_message(small_world().camera(), seconds));
    write<sensor_msgs_msg_dds__Image_>(image, image_message(small_world().image(), seconds));
  }
  std::string diagnostics() const {
    std::string text = status ? status->message : "no diagnostics";
    if (status)
      for (const msg::KeyValue& value : status->values) text += "\n  " + value.key + ": " + value.value;
    return text + "\n";
  }
  // Sends images until one is answered.
  bool send_until(const std::function<bool()>& condition, double seconds = 30) {
    double stamp = 1;
    auto next = std::chrono::steady_clock::now();
    return spin_until(
        [&] {
          if (std::chrono::steady_clock::now() > next) {
            next += std::chrono::milliseconds(200);
            send(stamp++);
          }
          return condition();
        },
        seconds);
  }
};

TEST(Program, DetectsInImagesOfATopic) {
  RunningProgram program(bracket());
  CameraPeer peer;
  ASSERT_TRUE(peer.send_until([&] { return !peer.detections.empty(); })) << peer.diagnostics() << program.log();
  const msg::Detection3DArray& found = peer.detections.front();
  EXPECT_EQ(found.header.frame_id, "camera");
  ASSERT_EQ(found.detections.size(), 1u);
  EXPECT_EQ(program.stop(), 0) << program.log();
}

}  // namespace

}  // namespace edgescout::ros2::test
