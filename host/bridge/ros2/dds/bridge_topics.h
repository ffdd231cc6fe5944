// The topics and services of the bridge on DDS.
#pragma once

#include <map>
#include <string>

#include "host/bridge/ros2/bridge.h"
#include "host/bridge/ros2/dds/dds_node.h"
#include "host/bridge/ros2/ros_arguments.h"

namespace edgescout::ros2 {

struct TopicOptions {
  bool is_compressed = false;      // of the images: IMAGE/compressed in place of IMAGE
  bool is_image_reliable = false;  // false: sensor data
  DepthSource depth = DepthSource::None;
};

// Writes the bridge's results.
class ResultTopics : public Outbox {
 public:
  ResultTopics(DdsNode& node, const RosArguments& ros);
  bool wants_markers() const override { return markers_.has_readers(); }
  bool wants_overlay() const override { return overlay_.has_readers(); }
  void send(const msg::Detection3DArray& detections) override;
  void send(const msg::MarkerArray& markers) override;
  void send(const msg::Image& overlay) override;
  void send(const msg::TFMessage& frames) override;
  void send(const msg::DiagnosticArray& diagnostics) const;

 private:
  DdsWriter detections_, markers_, overlay_, tf_, diagnostics_;
};

// Reads images, calibrations, transforms and requests for the bridge.
class InputTopics {
 public:
  InputTopics(DdsNode& node, const RosArguments& ros, const TopicOptions& options, Bridge& bridge);
  // Says in the diagnostics which topics nobody or more than one program writes, and how many
  // messages the network lost.
  void check() const;

 private:
  struct Input {
    std::string name;
    DdsReader reader;
  };
  void add_images(const TopicOptions& options);
  void add_depth(DepthSource depth, const Qos& qos);
  // The CameraInfo beside the topic `of`, unless `name` is mapped.
  std::string info_topic(const std::string& name, const std::string& of) const;
  void add_transforms();
  void add_requests();
  // A service and a pair of topics for one kind of request.
  template <typename Request, typename Result, typename Wires>
  void add_request(const std::string& name);
  template <typename Request, typename Result, typename RequestWire, typename ResultWire>
  void add_service(const std::string& name);
  template <typename Request, typename Result, typename RequestWire, typename ResultWire>
  void add_pair(const std::string& name);

  DdsNode& node_;
  RosArguments ros_;
  Bridge& bridge_;
  std::map<std::string, Input> inputs_;  // by their subject in the diagnostics
};

}  // namespace edgescout::ros2
