// ROS 2's messages as plain structs, with the names and units of their packages. Numbers of other
// wire types have the nearest type here; idl/ holds the types of the wire.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

namespace edgescout::ros2::msg {

struct Time {
  std::int32_t sec = 0;
  std::uint32_t nanosec = 0;
  bool operator==(const Time&) const = default;
};

struct Header {
  Time stamp{};
  std::string frame_id{};
};

struct Point {
  double x = 0, y = 0, z = 0;
};
using Vector3 = Point;

struct Quaternion {
  double x = 0, y = 0, z = 0, w = 1;
};

struct Pose {
  Point position{};
  Quaternion orientation{};
};

struct PoseStamped {
  Header header{};
  Pose pose{};
};

struct PoseWithCovariance {
  Pose pose{};
  std::array<double, 36> covariance{};  // by row: x, y, z, rotations about the fixed axes x, y, z
};

struct Transform {
  Vector3 translation{};
  Quaternion rotation{};
};

struct TransformStamped {
  Header header{};  // frame_id: the parent
  std::string child_frame_id{};
  Transform transform{};  // parent from child
};

struct TFMessage {
  std::vector<TransformStamped> transforms{};
};

struct ColorRGBA {
  float r = 0, g = 0, b = 0, a = 0;
};

struct Image {
  Header header{};
  std::uint32_t height = 0, width = 0;
  std::string encoding{};
  std::uint8_t is_bigendian = 0;
  std::uint32_t step = 0;  // bytes of a row
  std::vector<std::uint8_t> data{};
};

struct CompressedImage {
  Header header{};
  std::string format{};
  std::vector<std::uint8_t> data{};
};

struct RegionOfInterest {
  std::uint32_t x_offset = 0, y_offset = 0, height = 0, width = 0;
  bool do_rectify = false;
};

struct CameraInfo {
  Header header{};
  std::uint32_t height = 0, width = 0;
  std::string distortion_model{};
  std::vector<double> d{};
  std::array<double, 9> k{}, r{};
  std::array<double, 12> p{};
  std::uint32_t binning_x = 0, binning_y = 0;
  RegionOfInterest roi{};
};

struct KeyValue {
  std::string key{}, value{};
};

struct DiagnosticStatus {
  std::uint8_t level = 0;  // 0 ok, 1 warning, 2 error, 3 stale
  std::string name{}, message{}, hardware_id{};
  std::vector<KeyValue> values{};
};

struct DiagnosticArray {
  Header header{};
  std::vector<DiagnosticStatus> status{};
};

struct ObjectHypothesis {
  std::string class_id{};
  double score = 0;
};

struct ObjectHypothesisWithPose {
  ObjectHypothesis hypothesis{};
  PoseWithCovariance pose{};
};

struct BoundingBox3D {
  Pose center{};
  Vector3 size{};
};

struct Detection3D {
  Header header{};
  std::vector<ObjectHypothesisWithPose> results{};  // most probable first
  BoundingBox3D bbox{};
  std::string id{};
};

struct Detection3DArray {
  Header header{};
  std::vector<Detection3D> detections{};
};

// Textures and mesh files are left out: they are empty on the wire.
struct Marker {
  Header header{};
  std::string ns{};
  std::int32_t id = 0, type = 0, action = 0;
  Pose pose{};
  Vector3 scale{};
  ColorRGBA color{};
  std::vector<Point> points{};
};

struct MarkerArray {
  std::vector<Marker> markers{};
};

// Requests and results of the program's own, without what matches them to each other.

struct DetectRequest {
  double max_seconds = 0;
};
struct DetectResult {
  bool success = false;
  std::string message{};
  Detection3DArray detections{};
};

struct CalibratedImage {
  CameraInfo info{};
  Pose pose{};  // of the camera in the world
  Image image{};
  Image depth{};  // of the same camera; without pixels: none
};
struct PoseEstimate {
  std::uint64_t obj_id = 0;
  double score = 0;
  Pose pose{};
};
struct GetPoseEstimatesRequest {
  std::vector<std::uint64_t> object_ids{};
  std::vector<CalibratedImage> cameras{};
};
struct GetPoseEstimatesResult {
  bool success = false;
  std::string message{};
  std::vector<PoseEstimate> pose_estimates{};
};

struct ScoutProposeRequest {
  bool restart = false;
};
struct ScoutProposeResult {
  bool success = false;
  std::string message{};
  bool done = false;
  std::string end{};
  std::int32_t view = -1;
  PoseStamped camera_pose{};
};

struct ScoutGiveRequest {
  std::int32_t view = 0;
  bool failed = false;
  std::string reason{};
};
struct ScoutGiveResult {
  bool success = false;
  std::string message{};
};

struct ScoutStateRequest {};
struct ScoutStateResult {
  bool success = false;
  std::string message{}, end{};
  std::int32_t images = 0;
  double entropy_nats = 0;
  Detection3DArray detections{};
};

}  // namespace edgescout::ros2::msg
