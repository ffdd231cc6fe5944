#include <algorithm>
#include <functional>
#include <vector>

#include "host/core/words.h"
#include "host/io/camera_tree.h"
#include "kernels/error.h"

namespace edgescout {

using nlohmann::json;

namespace {

// Lines without blanks at their ends, empty lines and comments. rostopic's "%time" is none.
std::vector<std::string> lines_of(std::string_view text) {
  std::vector<std::string> lines;
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t end = std::min(text.find('\n', at), text.size());
    std::string line = trimmed(text.substr(at, end - at));
    const bool is_comment = line.starts_with('#') || line.starts_with("//") ||
                            (line.starts_with('%') && !line.starts_with("%time,"));
    if (!line.empty() && !is_comment) lines.push_back(std::move(line));
    at = end + 1;
  }
  return lines;
}

// cam_K.txt, also a 3x4 or 4x4 matrix, or "fx fy cx cy".
json numbers_alone(const std::vector<std::string>& lines) {
  std::string all;
  for (const std::string& line : lines) all += line + " ";
  const json numbers = numbers_in(all);
  if (numbers.is_null()) return nullptr;
  return {{"K", numbers}};
}

// CAMERA_ID MODEL WIDTH HEIGHT PARAMS[]
json colmap_camera(const std::string& line) {
  const std::vector<std::string> words = words_of(line);
  const auto is_name = [](const std::string& word) {
    return word.size() > 2 &&
           std::ranges::all_of(word, [](char c) { return (c >= 'A' && c <= 'Z') || c == '_'; });
  };
  if (words.size() < 5 || !is_name(words[1])) return nullptr;
  json values = json::array();
  for (std::size_t i = 0; i < words.size(); ++i)
    if (i != 1) values.push_back(scalar_of(words[i]));
  if (!std::ranges::all_of(values, [](const json& x) { return x.is_number(); })) return nullptr;
  return {{"camera_id", words[0]},
          {"model", words[1]},
          {"width", values[1]},
          {"height", values[2]},
          {"params", json(values.begin() + 3, values.end())}};
}

json colmap_cameras(const std::vector<std::string>& lines) {
  json cameras = json::array();
  for (const std::string& line : lines) {
    json camera = colmap_camera(line);
    if (camera.is_null()) return nullptr;
    cameras.push_back(std::move(camera));
  }
  return cameras.empty() ? json(nullptr) : cameras;
}

bool is_section(const std::string& line) {
  return line.size() > 2 && line[0] == '[' && line.back() == ']' && numbers_in(line).is_null() &&
         line.find(',') == std::string::npos;
}

// ROS camera_calibration: a name of several words on a line, its numbers on the next lines.
json ost_cameras(const std::vector<std::string>& lines, const std::string& source) {
  const auto is_matrix = [](const std::string& line) { return line == "camera matrix"; };
  if (std::ranges::none_of(lines, is_matrix)) return nullptr;
  json cameras = json::array();
  std::string name;
  for (const std::string& line : lines) {
    if (line == "[image]" || cameras.empty()) cameras.push_back(json::object());
    if (is_section(line)) {
      if (line != "[image]") cameras.back()["name"] = line.substr(1, line.size() - 2);
      continue;
    }
    const json numbers = numbers_in(line);
    if (numbers.is_null()) {
      add_field(cameras.back(), name = line, json::array(), source);
      continue;
    }
    if (name.empty()) throw InputError(source, "ost.txt", line, "the name of a field before it");
    for (const json& number : numbers) add_to_list(cameras.back(), name, number, source);
  }
  for (json& camera : cameras)
    for (const char* side : {"width", "height"})
      if (camera.contains(side) && camera[side].size() == 1) camera[side] = json(camera[side][0]);
  return cameras;
}

// Blocks "Intrinsic of "Color" / 640x480 / {..}" with lines "PPX: 319.5". Motion intrinsics and
// extrinsics, which have other headings, are skipped.
json realsense_cameras(const std::vector<std::string>& lines, const std::string& source) {
  constexpr std::string_view heading = "Intrinsic of \"";
  json cameras = json::array();
  bool is_inside = false;
  for (const std::string& line : lines) {
    if (line.starts_with(heading)) {
      const std::size_t end = line.find('"', heading.size());
      cameras.push_back({{"name", line.substr(heading.size(), end - heading.size())}});
      is_inside = true;
      continue;
    }
    const std::size_t colon = line.find(':');
    if (line.find("trinsic") != std::string::npos || colon == std::string::npos) is_inside = false;
    if (!is_inside) continue;
    const std::string value = trimmed(std::string_view(line).substr(colon + 1));
    add_field(cameras.back(), line.substr(0, colon), value_in(value), source);
  }
  return cameras.empty() ? json(nullptr) : cameras;
}

// "np.array([[1, 2]], dtype=float)" -> "[[1, 2]]".
std::string without_array(const std::string& value) {
  const std::size_t open = value.find('['), close = value.rfind(']');
  const bool is_array = open != std::string::npos && close != std::string::npos &&
                        value.substr(0, open).ends_with("array(");
  return is_array ? value.substr(open, close + 1 - open) : value;
}

// name = value, below [sections]. A comment may end a line. Also Python's assignments.
json ini_cameras(const std::vector<std::string>& lines, const std::string& source) {
  json root = json::object();
  json* section = &root;
  for (const std::string& line : with_whole_lists(lines, '=')) {
    if (line.empty() || line.starts_with("import ") || line.starts_with("from ")) continue;
    if (is_section(line)) {
      const std::string name = line.substr(1, line.size() - 2);
      add_field(root, name, json::object(), source);
      section = &root[name];
      continue;
    }
    const std::size_t equals = line.find('=');
    if (equals == std::string::npos || equals == 0 || line.find(':') < equals) return nullptr;
    std::string value = without_array(trimmed(line.substr(equals + 1)));
    if (value.size() > 1 && value.front() == '"' && value.back() == '"')
      value = value.substr(1, value.size() - 2);
    add_field(*section, trimmed(line.substr(0, equals)), value_in(value), source);
  }
  return root;
}

// What MATLAB shows of an object: "FocalLength: [700 701]" below "cameraIntrinsics with
// properties:". A value such as "[3x3 double]" is not shown.
json matlab_display(const std::vector<std::string>& lines, const std::string& source) {
  const auto is_heading = [](const std::string& line) {
    return line.ends_with("with properties:");
  };
  if (std::ranges::none_of(lines, is_heading)) return nullptr;
  json camera = json::object();
  for (const std::string& line : lines) {
    const std::size_t colon = line.find(": ");
    if (colon == std::string::npos) continue;
    const json value = value_in(trimmed(line.substr(colon + 2)));
    if (!value.is_string()) add_field(camera, line.substr(0, colon), value, source);
  }
  return camera;
}

// KITTI: "P0: 12 numbers", beside transforms of other sensors. A rectified image whose camera
// stands beside the first has the same left part.
json kitti_cameras(const std::vector<std::string>& lines) {
  json cameras = json::object();
  for (const std::string& line : lines) {
    const std::size_t colon = std::min(line.find(':'), line.size());
    const std::string name = line.substr(0, colon);
    const json p = numbers_in(std::string_view(line).substr(std::min(colon + 1, line.size())));
    const bool is_camera = name.size() == 2 && name[0] == 'P' && name[1] >= '0' && name[1] <= '9';
    const bool is_of_others = name.starts_with("Tr") || name.starts_with("R0");
    if (p.is_null() || (is_camera ? p.size() != 12 : !is_of_others)) return nullptr;
    if (is_camera) cameras[name]["K"] = {p[0], p[1], p[2], p[4], p[5], p[6], p[8], p[9], p[10]};
  }
  return cameras.empty() ? json(nullptr) : cameras;
}

}  // namespace

json text_camera_tree(std::string_view text, const std::string& source) {
  const std::vector<std::string> lines = lines_of(text);
  if (lines.empty()) return nullptr;
  if (json tree = dso_camera(lines, source); !tree.is_null()) return tree;
  if (json tree = halcon_camera(lines, source); !tree.is_null()) return tree;
  if (json tree = numbers_alone(lines); !tree.is_null()) return tree;
  if (json tree = kalibr_results(lines, source); !tree.is_null()) return tree;
  if (json tree = colmap_cameras(lines); !tree.is_null()) return tree;
  if (json tree = ost_cameras(lines, source); !tree.is_null()) return tree;
  if (json tree = realsense_cameras(lines, source); !tree.is_null()) return tree;
  if (json tree = matlab_display(lines, source); !tree.is_null()) return tree;
  if (json tree = kitti_cameras(lines); !tree.is_null()) return tree;
  if (json tree = printed_camera_tree(lines, source); !tree.is_null()) return tree;
  return ini_cameras(lines, source);
}

}  // namespace edgescout
