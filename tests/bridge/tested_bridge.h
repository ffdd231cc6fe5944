// A bridge on SmallWorld, and what it sent.
#pragma once

#include <gtest/gtest.h>

#include <functional>
#include <string>
#include <vector>

#include "host/bridge/ros2/bridge.h"
#include "tests/bridge/small_world.h"

namespace edgescout::ros2::test {

struct KeptResults : Outbox {
  bool wants = false;
  std::vector<msg::Detection3DArray> detections;
  std::vector<msg::MarkerArray> markers;
  std::vector<msg::Image> overlays;
  std::vector<msg::TFMessage> frames;
  bool wants_markers() const override { return wants; }
  bool wants_overlay() const override { return wants; }
  void send(const msg::Detection3DArray& message) override { detections.push_back(message); }
  void send(const msg::MarkerArray& message) override { markers.push_back(message); }
  void send(const msg::Image& message) override { overlays.push_back(message); }
  void send(const msg::TFMessage& message) override { frames.push_back(message); }
};

inline BridgeOptions quick() {
  BridgeOptions options;
  options.pipeline = SmallWorld::pipeline();
  options.tf_seconds = 0;
  return options;
}

struct TestedBridge {
  KeptResults results;
  Bridge bridge;
  int template_calls = 0;
  std::function<void()> while_working;  // called where templates are made
  IsCancelled are_cancelled;            // as the source of templates was told

  explicit TestedBridge(const BridgeOptions& options = quick())
      : bridge(
            [this](const Camera&, const IsCancelled& is_cancelled) {
              ++template_calls;
              are_cancelled = is_cancelled;
              if (while_working) while_working();
              return small_world().sets;
            },
            *small_world().backend, options, results) {}

  void give_info(double seconds = 1) { bridge.take(info_message(small_world().camera(), seconds)); }
  void give_image(double seconds = 1, std::size_t view = 0) {
    bridge.take(ImageMessage(image_message(small_world().image(view), seconds)));
  }
  std::uint64_t count(const std::string& what) { return bridge.diagnostics().counted(what); }
  msg::DiagnosticStatus status() { return bridge.diagnostics().message({}).status.at(0); }
  std::string problem(const std::string& subject) {
    return bridge.diagnostics().problem_of(subject);
  }
};

// The camera hangs on an arm: the world is where the scene says.
struct ArmBridge : TestedBridge {
  static BridgeOptions options() {
    BridgeOptions options = quick();
    options.world_frame = "world";
    options.publish_tf = true;
    options.scout.pipeline = options.pipeline;
    options.scout.max_views = 2;
    for (std::size_t view : {0, 1})
      options.scout_views.push_back(small_world().camera_from_world(view));
    return options;
  }
  explicit ArmBridge(const BridgeOptions& with = options()) : TestedBridge(with) {
    results.wants = true;
  }
  // The camera's pose at a time.
  void stand_at(std::size_t view, double seconds) {
    bridge.take({{transform_message("world", "camera",
                                    inverse(small_world().camera_from_world(view)), seconds)}},
                false);
  }
};

inline bool holds(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

inline void expect_same_pose(const msg::Pose& pose, const Se3& expected, double tolerance = 0) {
  const Se3 found = pose_of(pose, "pose");
  EXPECT_LE(distance_between_m(found, expected), tolerance);
  EXPECT_LE(angle_between_rad(found, expected), 1e-7 + tolerance);
}

}  // namespace edgescout::ros2::test
