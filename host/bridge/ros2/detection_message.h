// Makes ROS 2's messages of detections.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "host/bridge/ros2/messages.h"
#include "host/core/types.h"
#include "host/model/template_set.h"

namespace edgescout::ros2 {

// How messages name the objects: by their mesh, with the id where two meshes have one name.
std::vector<std::string> class_names(std::span<const TemplateSet> sets);

// The same detection in another frame: its poses, and the axes of its covariance.
Detection in_frame(const Se3& frame_from_world, const Detection& detection);

// The objects that detections refer to.
struct DetectedObjects {
  std::span<const TemplateSet> sets;
  std::vector<std::string> names;  // class_names
};

// `header` names the frame of the poses. The first hypothesis is the detection; others are its
// alternatives, without a covariance of their own. The box is that of the mesh.
msg::Detection3DArray detections_message(const msg::Header& header,
                                         std::span<const Detection> detections,
                                         const DetectedObjects& objects);

// The meshes as lists of triangles. The first marker removes those of the message before.
msg::MarkerArray markers_message(const msg::Header& header, std::span<const Detection> detections,
                                 const DetectedObjects& objects);

// One frame for each instance: "cube_0", "cube_1" .., most probable first.
msg::TFMessage frames_message(const msg::Header& header, std::span<const Detection> detections,
                              const DetectedObjects& objects);

}  // namespace edgescout::ros2
