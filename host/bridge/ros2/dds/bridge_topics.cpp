#include "host/bridge/ros2/dds/bridge_topics.h"

#include "kernels/error.h"

namespace edgescout::ros2 {

namespace {

// Names of DDS begin with their kind.
std::string topic(const std::string& name, const RosArguments& ros) {
  return "rt" + full_name(name, ros);
}

template <typename Wire, typename Plain>
void write(const DdsWriter& writer, const Plain& plain) {
  Wire wire{};
  ToWire io;
  io(plain, wire);
  writer.write(&wire);
}

template <typename Plain, typename Wire>
Plain plain_of(const Wire& wire) {
  Plain plain;
  FromWire io;
  io(plain, wire);
  return plain;
}

constexpr Qos sensor_data{.is_reliable = false, .depth = 5}, results{.depth = 10},
    // The newest picture counts.
    pictures{.depth = 1}, transforms{.depth = 100},
    static_transforms{.is_transient_local = true, .depth = 100}, services{.depth = 10};

// The wire types of a kind of request: of the pair of topics, and of the service.
struct DetectWires {
  using Request = edgescout_msgs_msg_dds__DetectRequest_;
  using Result = edgescout_msgs_msg_dds__DetectResult_;
  using ServiceRequest = edgescout_msgs_srv_dds__Detect_Request_;
  using ServiceResult = edgescout_msgs_srv_dds__Detect_Response_;
};
struct GetPoseEstimatesWires {
  using Request = edgescout_msgs_msg_dds__GetPoseEstimatesRequest_;
  using Result = edgescout_msgs_msg_dds__GetPoseEstimatesResult_;
  using ServiceRequest = edgescout_msgs_srv_dds__GetPoseEstimates_Request_;
  using ServiceResult = edgescout_msgs_srv_dds__GetPoseEstimates_Response_;
};
struct ScoutProposeWires {
  using Request = edgescout_msgs_msg_dds__ScoutProposeRequest_;
  using Result = edgescout_msgs_msg_dds__ScoutProposeResult_;
  using ServiceRequest = edgescout_msgs_srv_dds__ScoutPropose_Request_;
  using ServiceResult = edgescout_msgs_srv_dds__ScoutPropose_Response_;
};
struct ScoutGiveWires {
  using Request = edgescout_msgs_msg_dds__ScoutGiveRequest_;
  using Result = edgescout_msgs_msg_dds__ScoutGiveResult_;
  using ServiceRequest = edgescout_msgs_srv_dds__ScoutGive_Request_;
  using ServiceResult = edgescout_msgs_srv_dds__ScoutGive_Response_;
};
struct ScoutStateWires {
  using Request = edgescout_msgs_msg_dds__ScoutStateRequest_;
  using Result = edgescout_msgs_msg_dds__ScoutStateResult_;
  using ServiceRequest = edgescout_msgs_srv_dds__ScoutState_Request_;
  using ServiceResult = edgescout_msgs_srv_dds__ScoutState_Response_;
};

}  // namespace

ResultTopics::ResultTopics(DdsNode& node, const RosArguments& ros)
    : detections_(
          node.writer<vision_msgs_msg_dds__Detection3DArray_>(topic("~/detections", ros), results)),
      markers_(
          node.writer<visualization_msgs_msg_dds__MarkerArray_>(topic("~/markers", ros), pictures)),
      overlay_(node.writer<sensor_msgs_msg_dds__Image_>(topic("~/overlay", ros), pictures)),
      tf_(node.writer<tf2_msgs_msg_dds__TFMessage_>(topic("/tf", ros), transforms)),
      diagnostics_(node.writer<diagnostic_msgs_msg_dds__DiagnosticArray_>(
          topic("/diagnostics", ros), results)) {}

void ResultTopics::send(const msg::Detection3DArray& detections) {
  write<vision_msgs_msg_dds__Detection3DArray_>(detections_, detections);
}
void ResultTopics::send(const msg::MarkerArray& markers) {
  write<visualization_msgs_msg_dds__MarkerArray_>(markers_, markers);
}
void ResultTopics::send(const msg::Image& overlay) {
  write<sensor_msgs_msg_dds__Image_>(overlay_, overlay);
}
void ResultTopics::send(const msg::TFMessage& frames) {
  write<tf2_msgs_msg_dds__TFMessage_>(tf_, frames);
}
void ResultTopics::send(const msg::DiagnosticArray& diagnostics) const {
  write<diagnostic_msgs_msg_dds__DiagnosticArray_>(diagnostics_, diagnostics);
}

InputTopics::InputTopics(DdsNode& node, const RosArguments& ros, const TopicOptions& options,
                         Bridge& bridge)
    : node_(node), ros_(ros), bridge_(bridge) {
  add_images(options);
  add_transforms();
  add_requests();
}

void InputTopics::add_images(const TopicOptions& options) {
  Qos qos = sensor_data;
  qos.is_reliable = options.is_image_reliable;
  const std::string image = full_name("image", ros_) + (options.is_compressed ? "/compressed" : "");
  if (options.is_compressed)
    inputs_["image topic"] = {
        image, node_.subscribe<sensor_msgs_msg_dds__CompressedImage_>(
                   "rt" + image, qos, [this](const auto& wire) {
                     bridge_.take(ImageMessage(plain_of<msg::CompressedImage>(wire)));
                   })};
  else
    inputs_["image topic"] = {image, node_.subscribe<sensor_msgs_msg_dds__Image_>(
                                         "rt" + image, qos, [this](const auto& wire) {
                                           bridge_.take(ImageMessage(plain_of<msg::Image>(wire)));
                                         })};
  const std::string info = info_topic("camera_info", "image");
  inputs_["camera_info topic"] = {info, node_.subscribe<sensor_msgs_msg_dds__CameraInfo_>(
                                            "rt" + info, qos, [this](const auto& wire) {
                                              bridge_.take(plain_of<msg::CameraInfo>(wire));
                                            })};
  add_depth(options.depth, qos);
}

std::string InputTopics::info_topic(const std::string& name, const std::string& of) const {
  return ros_.names.contains(name) ? full_name(name, ros_)
                                   : beside(full_name(of, ros_), "camera_info");
}

void InputTopics::add_depth(DepthSource depth, const Qos& qos) {
  if (depth == DepthSource::None) return;
  const std::string image = full_name("depth", ros_);
  inputs_["depth topic"] = {image, node_.subscribe<sensor_msgs_msg_dds__Image_>(
                                       "rt" + image, qos, [this](const auto& wire) {
                                         bridge_.take_depth(plain_of<msg::Image>(wire));
                                       })};
  if (depth != DepthSource::OwnCamera) return;
  const std::string info = info_topic("depth_camera_info", "depth");
  if (info == info_topic("camera_info", "image"))
    throw InputError("depth", "camera_info", info + ", which is that of the images",
                     "a topic of its own: -r depth_camera_info:=TOPIC");
  inputs_["depth camera_info topic"] = {
      info,
      node_.subscribe<sensor_msgs_msg_dds__CameraInfo_>("rt" + info, qos, [this](const auto& wire) {
        bridge_.take_depth(plain_of<msg::CameraInfo>(wire));
      })};
}

void InputTopics::add_transforms() {
  const auto take = [this](bool is_static) {
    return [this, is_static](const tf2_msgs_msg_dds__TFMessage_& wire) {
      bridge_.take(plain_of<msg::TFMessage>(wire), is_static);
    };
  };
  node_.subscribe<tf2_msgs_msg_dds__TFMessage_>(topic("/tf", ros_), transforms, take(false));
  node_.subscribe<tf2_msgs_msg_dds__TFMessage_>(topic("/tf_static", ros_), static_transforms,
                                                take(true));
}

void InputTopics::add_requests() {
  add_request<msg::DetectRequest, msg::DetectResult, DetectWires>("~/detect");
  add_request<msg::GetPoseEstimatesRequest, msg::GetPoseEstimatesResult, GetPoseEstimatesWires>(
      "~/get_pose_estimates");
  add_request<msg::ScoutProposeRequest, msg::ScoutProposeResult, ScoutProposeWires>(
      "~/scout_propose");
  add_request<msg::ScoutGiveRequest, msg::ScoutGiveResult, ScoutGiveWires>("~/scout_give");
  add_request<msg::ScoutStateRequest, msg::ScoutStateResult, ScoutStateWires>("~/scout_state");
}

template <typename Request, typename Result, typename Wires>
void InputTopics::add_request(const std::string& name) {
  add_service<Request, Result, typename Wires::ServiceRequest, typename Wires::ServiceResult>(
      full_name(name, ros_));
  add_pair<Request, Result, typename Wires::Request, typename Wires::Result>(full_name(name, ros_));
}

template <typename Request, typename Result, typename RequestWire, typename ResultWire>
void InputTopics::add_service(const std::string& name) {
  const DdsWriter writer = node_.writer<ResultWire>("rr" + name + "Reply", services);
  node_.subscribe<RequestWire>(
      "rq" + name + "Request", services, [this, writer](const RequestWire& wire) {
        const auto answer = [writer, guid = wire.guid, seq = wire.seq](const Result& result) {
          ResultWire reply{};
          ToWire io;
          io(result, reply);
          reply.guid = guid;
          reply.seq = seq;
          writer.write(&reply);
        };
        bridge_.request(plain_of<Request>(wire), Answer<Result>(answer));
      });
}

template <typename Request, typename Result, typename RequestWire, typename ResultWire>
void InputTopics::add_pair(const std::string& name) {
  const DdsWriter writer = node_.writer<ResultWire>("rt" + name + "/result", results);
  node_.subscribe<RequestWire>(
      "rt" + name + "/request", results, [this, writer](const RequestWire& wire) {
        const auto answer = [writer, id = std::string(wire.id)](const Result& result) {
          ResultWire reply{};
          ToWire io;
          io(result, reply);
          io(id, reply.id);
          writer.write(&reply);
        };
        bridge_.request(plain_of<Request>(wire), Answer<Result>(answer));
      });
}

void InputTopics::check() const {
  Diagnostics& diagnostics = bridge_.diagnostics();
  for (const auto& [subject, input] : inputs_) {
    const std::uint32_t writers = input.reader.writers();
    if (writers == 1) {
      diagnostics.solved(subject);
    } else if (writers > 1) {
      diagnostics.problem(subject, input.name + ": found " + std::to_string(writers) +
                                       " publishers, expected one: their messages mix");
    } else {
      const std::uint32_t apart = input.reader.incompatible_writers();
      diagnostics.problem(subject, apart == 0
                                       ? input.name + ": found no publisher, expected one"
                                       : input.name +
                                             ": found publishers of sensor data only, expected a "
                                             "reliable one, or image_qos: sensor_data");
    }
    diagnostics.set(subject + ", messages lost by the network",
                    std::to_string(input.reader.lost()));
  }
}

}  // namespace edgescout::ros2
