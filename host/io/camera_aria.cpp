// Cameras of Project Aria: the factory calibration of a recording, in which the label of a camera
// says its size.
#include <algorithm>
#include <cmath>

#include "host/io/camera_programs.h"

namespace edgescout {

using nlohmann::json;

namespace {

struct AriaSensor {
  std::string_view label;
  int width, height;
  bool is_binned_too;   // it also records images of half the size
  int cut_from_binned;  // px of the sensor at each side
};
constexpr AriaSensor aria_sensors[] = {{"camera-slam-left", 640, 480, false, 0},
                                       {"camera-slam-right", 640, 480, false, 0},
                                       {"camera-et-left", 640, 480, true, 0},
                                       {"camera-et-right", 640, 480, true, 0},
                                       {"camera-rgb", 2880, 2880, true, 32}};

// Whether the principal point is that of an image of this size: later devices have other sensors.
bool is_on_aria_sensor(const JsonField& list, const AriaSensor& sensor) {
  constexpr double most_off_centre = 0.1;
  const std::vector<double> p = numbers_in_field(list);  // f cx cy ..
  return p.size() > 2 && std::abs(p[1] / sensor.width - 0.5) < most_off_centre &&
         std::abs(p[2] / sensor.height - 0.5) < most_off_centre;
}

// The camera in each size of image that the device records; without a size where it is not known.
json in_arias_sizes(const json& camera, const AriaSensor& sensor) {
  json full = camera;
  full["width"] = sensor.width;
  full["height"] = sensor.height;
  json cameras = json::array({full});
  if (!sensor.is_binned_too) return cameras;
  const int cut = sensor.cut_from_binned;
  full["roi"] = {{"x_offset", cut},
                 {"y_offset", cut},
                 {"width", sensor.width - 2 * cut},
                 {"height", sensor.height - 2 * cut}};
  full["binning_x"] = full["binning_y"] = 2;
  cameras.push_back(full);
  return cameras;
}

}  // namespace

bool is_of_aria(const json& tree) {
  return tree.is_object() && tree.contains("CameraCalibrations") &&
         tree["CameraCalibrations"].is_array();
}

json aria_cameras(const JsonField& root) {
  json cameras = json::array();
  for (const JsonField& camera : root.at("CameraCalibrations").elements()) {
    const std::string label = camera.at("Label").text();
    const JsonField projection = camera.at("Projection");
    const json read = {{"name", label},
                       {"projection_model_type", projection.at("Name").value},
                       {"projection_params", projection.at("Params").value}};
    const auto* sensor = std::ranges::find(aria_sensors, label, &AriaSensor::label);
    if (sensor == std::end(aria_sensors) || !is_on_aria_sensor(projection.at("Params"), *sensor))
      cameras.push_back(read);
    else
      for (const json& sized : in_arias_sizes(read, *sensor)) cameras.push_back(sized);
  }
  return cameras;
}

}  // namespace edgescout
