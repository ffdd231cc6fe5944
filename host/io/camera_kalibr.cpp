// What Kalibr writes for eyes: results-cam.txt and results-imucam.txt.
#include <algorithm>

#include "host/core/words.h"
#include "host/io/camera_fields.h"
#include "host/io/camera_tree.h"

namespace edgescout {

using nlohmann::json;

namespace {

// "cam0" of "cam0 (/left/image_raw):", "cam0" and "Camera: cam0". Empty: the line is no heading.
std::string camera_of_heading(const std::string& line) {
  constexpr std::string_view of_imu = "Camera: ";
  const std::string text = line.starts_with(of_imu) ? line.substr(of_imu.size()) : line;
  const std::size_t end = text.find_first_of(" (:");
  const std::string name = text.substr(0, end);
  const bool is_heading = end == std::string::npos || (text[end] == ' ' && text.ends_with("):"));
  const bool is_camera = name.starts_with("cam") && name.size() > 3 &&
                         name.find_first_not_of("0123456789", 3) == std::string::npos;
  return is_heading && is_camera ? name : "";
}

// "<class 'aslam_cv.libaslam_cv_python.DistortedPinholeRsCameraGeometry'>" -> "DistortedPinhole".
std::string geometry_in(const std::string& type) {
  std::string name = type.substr(std::min(type.rfind('.') + 1, type.size()));
  name = name.substr(0, name.find_first_of("'>"));
  for (const std::string_view ending : {"CameraGeometry", "Rs"})
    if (name.ends_with(ending)) name.resize(name.size() - ending.size());
  return name;
}

// A field of a camera, without its standard deviation.
void add_line(json& camera, const std::string& line, const std::string& source) {
  const std::size_t colon = line.find(": ");
  if (colon == std::string::npos) return;
  const std::string name = plain_name(line.substr(0, colon));
  const std::string value = trimmed(line.substr(colon + 2, line.find("+-") - colon - 2));
  if (name == "type" && value.find("CameraGeometry") != std::string::npos)
    add_field(camera, "camera_model", geometry_in(value), source);
  else if (name == "projection")
    add_field(camera, "intrinsics", value_in(value), source);
  else if (is_any_of(name, {"distortion", "cameramodel", "focallength", "principalpoint", "omnixi",
                            "distortionmodel", "distortioncoefficients", "resolution"}))
    add_field(camera, line.substr(0, colon), value_in(value), source);
}

}  // namespace

json kalibr_results(const std::vector<std::string>& lines, const std::string& source) {
  if (!lines.front().starts_with("Calibration results")) return nullptr;
  json cameras = json::object();
  std::string name;
  // numpy cuts a long list into lines.
  for (const std::string& line : with_whole_lists(lines, ':')) {
    if (const std::string heading = camera_of_heading(line); !heading.empty()) {
      name = heading;
    } else if (line.starts_with("baseline ") || line.starts_with("Target config") ||
               line.starts_with("IMU")) {
      name.clear();
    } else if (!name.empty()) {
      add_line(cameras[name], line, source);
    }
  }
  std::erase_if(cameras.get_ref<json::object_t&>(),
                [](const auto& camera) { return camera.second.is_null(); });
  return cameras.empty() ? json(nullptr) : cameras;
}

}  // namespace edgescout
