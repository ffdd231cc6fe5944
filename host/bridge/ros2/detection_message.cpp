#include "host/bridge/ros2/detection_message.h"

#include <algorithm>
#include <map>

#include "host/bridge/ros2/frames.h"

namespace edgescout::ros2 {

namespace {

constexpr std::int32_t triangle_list = 11, delete_all = 3;  // visualization_msgs/Marker

msg::Point point_of(const Eigen::Vector3d& p) { return {p.x(), p.y(), p.z()}; }

std::array<double, 36> numbers_of(const Matrix6d& covariance) {
  std::array<double, 36> numbers{};
  Eigen::Map<Eigen::Matrix<double, 6, 6, Eigen::RowMajor>>(numbers.data()) = covariance;
  return numbers;
}

msg::Detection3D message_of(const msg::Header& header, const Detection& detection,
                            const std::string& name, const Mesh& mesh) {
  msg::Detection3D message{.header = header};
  message.results.push_back(
      {{name, detection.probability},
       {ros2::message_of(detection.world_from_object), numbers_of(detection.covariance)}});
  for (const AlternativePose& other : detection.alternatives)
    message.results.push_back(
        {{name, other.probability}, {ros2::message_of(other.world_from_object), {}}});
  Se3 object_from_box;
  object_from_box.translation_m = (mesh.box_min_m + mesh.box_max_m) / 2;
  message.bbox.center = ros2::message_of(detection.world_from_object * object_from_box);
  message.bbox.size = point_of(mesh.box_max_m - mesh.box_min_m);
  return message;
}

// "cube_0": number of each instance of its class, in the order given.
std::vector<std::string> instance_names(std::span<const Detection> detections,
                                        const DetectedObjects& objects) {
  std::map<int, int> next;
  std::vector<std::string> names;
  for (const Detection& detection : detections)
    names.push_back(objects.names[std::size_t(detection.object)] + "_" +
                    std::to_string(next[detection.object]++));
  return names;
}

const Mesh& mesh_of(const DetectedObjects& objects, const Detection& detection) {
  return objects.sets[std::size_t(detection.object)].model.mesh;
}

msg::Marker marker_of(const msg::Header& header, const Detection& detection, const Mesh& mesh) {
  msg::Marker marker{.header = header,
                     .type = triangle_list,
                     .pose = ros2::message_of(detection.world_from_object),
                     .scale = {1, 1, 1}};
  const auto share = float(detection.probability);  // green where it is sure, else red
  marker.color = {1 - share, share, 0.2F, 0.6F};
  marker.points.reserve(3 * mesh.triangles.size());
  for (const std::array<int, 3>& triangle : mesh.triangles)
    for (const int corner : triangle)
      marker.points.push_back(point_of(mesh.vertices_m[std::size_t(corner)]));
  return marker;
}

}  // namespace

std::vector<std::string> class_names(std::span<const TemplateSet> sets) {
  std::map<std::string, int> count;
  for (const TemplateSet& set : sets) ++count[set.model.mesh.name];
  std::vector<std::string> names;
  for (const TemplateSet& set : sets) {
    const std::string& name = set.model.mesh.name;
    names.push_back(count[name] == 1 ? name : name + "_" + std::to_string(set.object_id));
  }
  return names;
}

Detection in_frame(const Se3& frame_from_world, const Detection& detection) {
  Detection moved = detection;
  moved.world_from_object = frame_from_world * detection.world_from_object;
  Matrix6d turn = Matrix6d::Zero();
  turn.topLeftCorner<3, 3>() = turn.bottomRightCorner<3, 3>() =
      frame_from_world.rotation.toRotationMatrix();
  moved.covariance = turn * detection.covariance * turn.transpose();
  for (AlternativePose& other : moved.alternatives)
    other.world_from_object = frame_from_world * other.world_from_object;
  return moved;
}

msg::Detection3DArray detections_message(const msg::Header& header,
                                         std::span<const Detection> detections,
                                         const DetectedObjects& objects) {
  msg::Detection3DArray message{header, {}};
  const std::vector<std::string> ids = instance_names(detections, objects);
  for (std::size_t i = 0; i < detections.size(); ++i) {
    const Detection& detection = detections[i];
    message.detections.push_back(message_of(header, detection,
                                            objects.names[std::size_t(detection.object)],
                                            mesh_of(objects, detection)));
    message.detections.back().id = ids[i];
  }
  return message;
}

msg::MarkerArray markers_message(const msg::Header& header, std::span<const Detection> detections,
                                 const DetectedObjects& objects) {
  msg::MarkerArray message;
  message.markers.push_back({.header = header, .action = delete_all});
  for (std::size_t i = 0; i < detections.size(); ++i) {
    message.markers.push_back(marker_of(header, detections[i], mesh_of(objects, detections[i])));
    message.markers.back().ns = objects.names[std::size_t(detections[i].object)];
    message.markers.back().id = std::int32_t(i);
  }
  return message;
}

msg::TFMessage frames_message(const msg::Header& header, std::span<const Detection> detections,
                              const DetectedObjects& objects) {
  msg::TFMessage message;
  const std::vector<std::string> names = instance_names(detections, objects);
  for (std::size_t i = 0; i < detections.size(); ++i)
    message.transforms.push_back({header, names[i], transform_of(detections[i].world_from_object)});
  return message;
}

}  // namespace edgescout::ros2
