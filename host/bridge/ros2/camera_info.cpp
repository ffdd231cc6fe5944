#include "host/bridge/ros2/camera_info.h"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <span>

#include "host/io/camera_file.h"
#include "kernels/error.h"

namespace edgescout::ros2 {

namespace {

using nlohmann::json;

// JSON has no such numbers and would lose them.
void require_finite(std::span<const double> values, const char* field, const std::string& source) {
  for (const double value : values)
    if (!std::isfinite(value))
      throw InputError(source, field, std::to_string(value), "finite numbers");
}

std::array<double, 9> left_of(const std::array<double, 12>& p) {
  return {p[0], p[1], p[2], p[4], p[5], p[6], p[8], p[9], p[10]};
}

void require_calibrated(std::span<const double> matrix, const char* field,
                        const std::string& source) {
  if (std::ranges::all_of(matrix, [](double value) { return value == 0; }))
    throw InputError(source, field, "zeros: an uncalibrated camera",
                     "a calibration, or the option camera with its file");
}

json lens_of(const msg::CameraInfo& info, const std::string& source) {
  constexpr std::size_t most = 64;
  require_finite(info.d, "d", source);
  if (info.d.size() > most)
    throw InputError(source, "d", std::to_string(info.d.size()) + " numbers",
                     "at most " + std::to_string(most));
  json lens{{"distortion_coefficients", {{"data", info.d}}}};
  if (!info.distortion_model.empty())
    lens["distortion_model"] = info.distortion_model.substr(0, 64);
  return lens;
}

// The fields of a calibration file of ROS.
json file_of(const msg::CameraInfo& info, bool rectified, const std::string& source) {
  const char* field = rectified ? "p" : "k";
  const std::array<double, 9> matrix = rectified ? left_of(info.p) : info.k;
  require_finite(matrix, field, source);
  require_calibrated(matrix, field, source);
  json file = rectified ? json::object() : lens_of(info, source);
  file["camera_matrix"] = {{"rows", 3}, {"cols", 3}, {"data", matrix}};
  if (info.width != 0 || info.height != 0) {
    file["image_width"] = info.width;
    file["image_height"] = info.height;
  }
  file["binning_x"] = info.binning_x;
  file["binning_y"] = info.binning_y;
  const msg::RegionOfInterest& roi = info.roi;
  if (roi.width != 0 || roi.height != 0 || roi.x_offset != 0 || roi.y_offset != 0)
    file["roi"] = {{"x_offset", roi.x_offset},
                   {"y_offset", roi.y_offset},
                   {"width", roi.width},
                   {"height", roi.height}};
  return file;
}

std::string file_text(const json& file) {
  return file.dump(-1, ' ', true, json::error_handler_t::replace);
}

}  // namespace

Camera camera_of(const msg::CameraInfo& info, bool rectified, const std::string& source) {
  return cameras_in(file_text(file_of(info, rectified, source)), source).at(0).camera;
}

void CameraInfos::add(const msg::CameraInfo& info) {
  constexpr std::size_t kept = 8;
  infos_.push_back(info);
  if (infos_.size() > kept) infos_.pop_front();
}

const msg::CameraInfo* CameraInfos::for_image(const msg::Header& image) const {
  if (infos_.empty()) return nullptr;
  const auto same_time =
      std::find_if(infos_.rbegin(), infos_.rend(),
                   [&](const msg::CameraInfo& info) { return info.header.stamp == image.stamp; });
  return same_time == infos_.rend() ? &infos_.back() : &*same_time;
}

}  // namespace edgescout::ros2
