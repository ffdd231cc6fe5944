// Pairs the fields of plain messages with those of the types that idlc generates. Each pair is
// stated once, for both directions.
#pragma once

#include <algorithm>
#include <array>
#include <cstring>
#include <deque>
#include <memory>
#include <string>
#include <type_traits>
#include <vector>

#include "host/bridge/ros2/messages.h"

#include "diagnostic_msgs.h"
#include "edgescout_msgs.h"
#include "geometry_msgs.h"
#include "sensor_msgs.h"
#include "tf2_msgs.h"
#include "vision_msgs.h"
#include "visualization_msgs.h"

namespace edgescout::ros2 {

template <typename Wire>
concept Sequence = requires(Wire& wire) {
  wire._buffer;
  wire._length;
};

// Copies a message of the wire.
class FromWire {
 public:
  template <typename Plain, typename Wire>
  void operator()(Plain& plain, const Wire& wire) {
    if constexpr (std::is_arithmetic_v<Plain>)
      plain = static_cast<Plain>(wire);
    else
      fields(*this, plain, const_cast<Wire&>(wire));
  }
  void operator()(std::string& plain, char* const& wire) { plain = wire ? wire : ""; }
  template <typename T, std::size_t N>
  void operator()(std::array<T, N>& plain, const T (&wire)[N]) {
    std::copy(wire, wire + N, plain.begin());
  }
  template <typename T, Sequence Wire>
  void operator()(std::vector<T>& plain, const Wire& wire) {
    if constexpr (std::is_arithmetic_v<T>) {
      plain.assign(wire._buffer, wire._buffer + wire._length);
    } else {
      plain.resize(wire._length);
      for (std::size_t i = 0; i < plain.size(); ++i) (*this)(plain[i], wire._buffer[i]);
    }
  }
};

// Fills a message of the wire, which then points into the plain one and into this object: both must
// outlive it, and it is not freed.
class ToWire {
 public:
  template <typename Plain, typename Wire>
  void operator()(const Plain& plain, Wire& wire) {
    if constexpr (std::is_arithmetic_v<Plain>)
      wire = static_cast<Wire>(plain);
    else
      fields(*this, const_cast<Plain&>(plain), wire);
  }
  void operator()(const std::string& plain, char*& wire) {
    wire = const_cast<char*>(plain.c_str());
  }
  template <typename T, std::size_t N>
  void operator()(const std::array<T, N>& plain, T (&wire)[N]) {
    std::ranges::copy(plain, wire);
  }
  template <typename T, Sequence Wire>
  void operator()(const std::vector<T>& plain, Wire& wire) {
    using Element = std::remove_pointer_t<decltype(wire._buffer)>;
    wire._length = wire._maximum = static_cast<std::uint32_t>(plain.size());
    wire._release = false;
    if constexpr (std::is_same_v<T, Element>) {
      wire._buffer = const_cast<T*>(plain.data());
    } else {
      const auto buffer = std::make_shared<Element[]>(plain.size());
      buffers_.push_back(buffer);
      wire._buffer = buffer.get();
      for (std::size_t i = 0; i < plain.size(); ++i) (*this)(plain[i], buffer[i]);
    }
  }

 private:
  std::deque<std::shared_ptr<void>> buffers_;
};

template <typename Io>
void fields(Io& io, msg::Time& p, builtin_interfaces_msg_dds__Time_& w) {
  io(p.sec, w.sec), io(p.nanosec, w.nanosec);
}
template <typename Io>
void fields(Io& io, msg::Header& p, std_msgs_msg_dds__Header_& w) {
  io(p.stamp, w.stamp), io(p.frame_id, w.frame_id);
}
template <typename Io>
void fields(Io& io, msg::Point& p, geometry_msgs_msg_dds__Point_& w) {
  io(p.x, w.x), io(p.y, w.y), io(p.z, w.z);
}
template <typename Io>
void fields(Io& io, msg::Vector3& p, geometry_msgs_msg_dds__Vector3_& w) {
  io(p.x, w.x), io(p.y, w.y), io(p.z, w.z);
}
template <typename Io>
void fields(Io& io, msg::Quaternion& p, geometry_msgs_msg_dds__Quaternion_& w) {
  io(p.x, w.x), io(p.y, w.y), io(p.z, w.z), io(p.w, w.w);
}
template <typename Io>
void fields(Io& io, msg::Pose& p, geometry_msgs_msg_dds__Pose_& w) {
  io(p.position, w.position), io(p.orientation, w.orientation);
}
template <typename Io>
void fields(Io& io, msg::PoseStamped& p, geometry_msgs_msg_dds__PoseStamped_& w) {
  io(p.header, w.header), io(p.pose, w.pose);
}
template <typename Io>
void fields(Io& io, msg::PoseWithCovariance& p, geometry_msgs_msg_dds__PoseWithCovariance_& w) {
  io(p.pose, w.pose), io(p.covariance, w.covariance);
}
template <typename Io>
void fields(Io& io, msg::Transform& p, geometry_msgs_msg_dds__Transform_& w) {
  io(p.translation, w.translation), io(p.rotation, w.rotation);
}
template <typename Io>
void fields(Io& io, msg::TransformStamped& p, geometry_msgs_msg_dds__TransformStamped_& w) {
  io(p.header, w.header), io(p.child_frame_id, w.child_frame_id), io(p.transform, w.transform);
}
template <typename Io>
void fields(Io& io, msg::TFMessage& p, tf2_msgs_msg_dds__TFMessage_& w) {
  io(p.transforms, w.transforms);
}
template <typename Io>
void fields(Io& io, msg::ColorRGBA& p, std_msgs_msg_dds__ColorRGBA_& w) {
  io(p.r, w.r), io(p.g, w.g), io(p.b, w.b), io(p.a, w.a);
}
template <typename Io>
void fields(Io& io, msg::Image& p, sensor_msgs_msg_dds__Image_& w) {
  io(p.header, w.header), io(p.height, w.height), io(p.width, w.width);
  io(p.encoding, w.encoding), io(p.is_bigendian, w.is_bigendian), io(p.step, w.step);
  io(p.data, w.data);
}
template <typename Io>
void fields(Io& io, msg::CompressedImage& p, sensor_msgs_msg_dds__CompressedImage_& w) {
  io(p.header, w.header), io(p.format, w.format), io(p.data, w.data);
}
template <typename Io>
void fields(Io& io, msg::RegionOfInterest& p, sensor_msgs_msg_dds__RegionOfInterest_& w) {
  io(p.x_offset, w.x_offset), io(p.y_offset, w.y_offset);
  io(p.height, w.height), io(p.width, w.width), io(p.do_rectify, w.do_rectify);
}
template <typename Io>
void fields(Io& io, msg::CameraInfo& p, sensor_msgs_msg_dds__CameraInfo_& w) {
  io(p.header, w.header), io(p.height, w.height), io(p.width, w.width);
  io(p.distortion_model, w.distortion_model), io(p.d, w.d);
  io(p.k, w.k), io(p.r, w.r), io(p.p, w.p);
  io(p.binning_x, w.binning_x), io(p.binning_y, w.binning_y), io(p.roi, w.roi);
}
template <typename Io>
void fields(Io& io, msg::KeyValue& p, diagnostic_msgs_msg_dds__KeyValue_& w) {
  io(p.key, w.key), io(p.value, w.value);
}
template <typename Io>
void fields(Io& io, msg::DiagnosticStatus& p, diagnostic_msgs_msg_dds__DiagnosticStatus_& w) {
  io(p.level, w.level), io(p.name, w.name), io(p.message, w.message);
  io(p.hardware_id, w.hardware_id), io(p.values, w.values);
}
template <typename Io>
void fields(Io& io, msg::DiagnosticArray& p, diagnostic_msgs_msg_dds__DiagnosticArray_& w) {
  io(p.header, w.header), io(p.status, w.status);
}
template <typename Io>
void fields(Io& io, msg::ObjectHypothesis& p, vision_msgs_msg_dds__ObjectHypothesis_& w) {
  io(p.class_id, w.class_id), io(p.score, w.score);
}
template <typename Io>
void fields(Io& io, msg::ObjectHypothesisWithPose& p,
            vision_msgs_msg_dds__ObjectHypothesisWithPose_& w) {
  io(p.hypothesis, w.hypothesis), io(p.pose, w.pose);
}
template <typename Io>
void fields(Io& io, msg::BoundingBox3D& p, vision_msgs_msg_dds__BoundingBox3D_& w) {
  io(p.center, w.center), io(p.size, w.size);
}
template <typename Io>
void fields(Io& io, msg::Detection3D& p, vision_msgs_msg_dds__Detection3D_& w) {
  io(p.header, w.header), io(p.results, w.results), io(p.bbox, w.bbox), io(p.id, w.id);
}
template <typename Io>
void fields(Io& io, msg::Detection3DArray& p, vision_msgs_msg_dds__Detection3DArray_& w) {
  io(p.header, w.header), io(p.detections, w.detections);
}
template <typename Io>
void fields(Io& io, msg::Marker& p, visualization_msgs_msg_dds__Marker_& w) {
  io(p.header, w.header), io(p.ns, w.ns), io(p.id, w.id), io(p.type, w.type);
  io(p.action, w.action), io(p.pose, w.pose), io(p.scale, w.scale), io(p.color, w.color);
  io(p.points, w.points);
  if constexpr (std::is_same_v<Io, ToWire>) {  // every string of the wire must be one
    static const std::string none;
    for (char** text : {&w.texture_resource, &w.texture.header.frame_id, &w.texture.format, &w.text,
                        &w.mesh_resource, &w.mesh_file.filename})
      io(none, *text);
  }
}
template <typename Io>
void fields(Io& io, msg::MarkerArray& p, visualization_msgs_msg_dds__MarkerArray_& w) {
  io(p.markers, w.markers);
}
template <typename Io>
void fields(Io& io, msg::CalibratedImage& p, edgescout_msgs_msg_dds__CalibratedImage_& w) {
  io(p.info, w.info), io(p.pose, w.pose), io(p.image, w.image), io(p.depth, w.depth);
}
template <typename Io>
void fields(Io& io, msg::PoseEstimate& p, edgescout_msgs_msg_dds__PoseEstimate_& w) {
  io(p.obj_id, w.obj_id), io(p.score, w.score), io(p.pose, w.pose);
}

// Requests and results: the wire type is that of the topic or that of the service.

template <typename Io, typename Wire>
void fields(Io& io, msg::DetectRequest& p, Wire& w) {
  io(p.max_seconds, w.max_seconds);
}
template <typename Io, typename Wire>
void fields(Io& io, msg::DetectResult& p, Wire& w) {
  io(p.success, w.success), io(p.message, w.message), io(p.detections, w.detections);
}
template <typename Io, typename Wire>
void fields(Io& io, msg::GetPoseEstimatesRequest& p, Wire& w) {
  io(p.object_ids, w.object_ids), io(p.cameras, w.cameras);
}
template <typename Io, typename Wire>
void fields(Io& io, msg::GetPoseEstimatesResult& p, Wire& w) {
  io(p.success, w.success), io(p.message, w.message), io(p.pose_estimates, w.pose_estimates);
}
template <typename Io, typename Wire>
void fields(Io& io, msg::ScoutProposeRequest& p, Wire& w) {
  io(p.restart, w.restart);
}
template <typename Io, typename Wire>
void fields(Io& io, msg::ScoutProposeResult& p, Wire& w) {
  io(p.success, w.success), io(p.message, w.message), io(p.done, w.done), io(p.end, w.end);
  io(p.view, w.view), io(p.camera_pose, w.camera_pose);
}
template <typename Io, typename Wire>
void fields(Io& io, msg::ScoutGiveRequest& p, Wire& w) {
  io(p.view, w.view), io(p.failed, w.failed), io(p.reason, w.reason);
}
template <typename Io, typename Wire>
void fields(Io& io, msg::ScoutGiveResult& p, Wire& w) {
  io(p.success, w.success), io(p.message, w.message);
}
template <typename Io, typename Wire>
void fields(Io&, msg::ScoutStateRequest&, Wire&) {}
template <typename Io, typename Wire>
void fields(Io& io, msg::ScoutStateResult& p, Wire& w) {
  io(p.success, w.success), io(p.message, w.message), io(p.end, w.end);
  io(p.images, w.images), io(p.entropy_nats, w.entropy_nats), io(p.detections, w.detections);
}

}  // namespace edgescout::ros2
