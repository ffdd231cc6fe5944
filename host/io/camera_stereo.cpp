#include <map>

#include "host/io/camera_reader.h"

namespace edgescout {

using nlohmann::json;

namespace {

struct SidedName {
  std::string side, name;
};

// "M1", "left_camera_matrix", "distCoeffsR". Empty: the name has no side.
SidedName sided_name(const std::string& written) {
  const std::string plain = plain_name(written);
  for (const std::string side : {"left", "right", "1", "2", "l", "r"}) {
    std::string name;
    if (plain.ends_with(side))
      name = plain.substr(0, plain.size() - side.size());
    else if (side.size() > 1 && plain.starts_with(side))
      name = plain.substr(side.size());
    if (name == "m") name = "k";  // of OpenCV's sample
    if (is_matrix_name(name) || is_distortion_name(name)) return {side, name};
  }
  return {};
}

}  // namespace

json split_stereo_pair(const json& fields) {
  std::map<std::string, json> cameras;
  json others = json::object();
  for (const auto& [key, value] : fields.items()) {
    const SidedName sided = sided_name(key);
    if (!sided.side.empty() && is_list(value))
      cameras[sided.side][sided.name] = value;
    else
      others[key] = value;
  }
  int matrices = 0;
  for (auto& [side, camera] : cameras) {
    for (const auto& [name, value] : camera.items()) matrices += is_matrix_name(name);
    others[side] = camera;
  }
  return matrices > 1 ? others : json(nullptr);
}

}  // namespace edgescout
