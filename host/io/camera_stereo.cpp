#include <algorithm>
#include <array>
#include <cctype>
#include <map>
#include <optional>
#include <vector>

#include "host/io/camera_reader.h"

namespace edgescout {

using nlohmann::json;

namespace {

struct SidedName {
  std::string side, name;
};

constexpr std::array side_words{"left", "right", "color",    "colour",
                                "rgb",  "depth", "infrared", "ir"};

std::size_t digits_at(std::string_view text, std::size_t from) {
  std::size_t count = 0;
  while (from + count < text.size() && std::isdigit(static_cast<unsigned char>(text[from + count])))
    ++count;
  return count;
}

// Lengths of what may be a side at the beginning of a plain name: "left", "infra1", "camera0".
std::optional<std::size_t> side_before(std::string_view plain) {
  for (const std::string_view word : side_words)
    if (plain.starts_with(word)) return word.size() + digits_at(plain, word.size());
  for (const std::string_view word : {"camera", "cam", "infra"})
    if (plain.starts_with(word))
      if (const std::size_t digits = digits_at(plain, word.size()); digits > 0)
        return word.size() + digits;
  return {};
}

// Where it may begin at the end: "M1", "K_00", "distCoeffsR".
std::optional<std::size_t> side_after(std::string_view plain) {
  for (const std::string_view word : side_words)
    if (plain.ends_with(word)) return plain.size() - word.size();
  if (plain.ends_with('l') || plain.ends_with('r')) return plain.size() - 1;
  const std::size_t last = plain.find_last_not_of("0123456789");
  if (last == std::string_view::npos || last + 1 == plain.size() || plain.size() - last > 3)
    return {};
  return last + 1;
}

bool is_one_number(std::string_view name) { return is_any_of(name, {"fx", "fy", "cx", "cy"}); }

bool is_coefficient(std::string_view name) {
  return is_any_of(name, {"k1", "k2", "k3", "k4", "k5", "k6", "p1", "p2"});
}

bool is_size(std::string_view name) {
  return is_any_of(
      name, {"width", "height", "imagewidth", "imageheight", "imagesize", "size", "resolution"});
}

// A number at the end of a name of one number is a part of the name: k1.
bool is_of_camera(std::string_view name, const json& value, bool is_numbered) {
  if (value.is_number())
    return is_one_number(name) || is_size(name) || (!is_numbered && is_coefficient(name));
  return (value.is_object() || is_list(value)) &&
         (is_matrix_name(name) || is_distortion_name(name) || is_size(name));
}

// Middlebury's "cam0=[700 0 321; 0 701 238; 0 0 1]": the name of the camera is that of its matrix.
bool is_intrinsic_matrix(const json& value) {
  if (!value.is_array() || value.size() != 9 || !std::ranges::all_of(value, &json::is_number))
    return false;
  const std::vector<double> k = value;
  return k[0] > 2 && k[4] > 2 && k[3] == 0 && k[6] == 0 && k[7] == 0 && k[8] == 1;
}

// Empty: the field has no side.
SidedName sided_name(const std::string& written, const json& value) {
  const std::string plain = plain_name(written);
  const auto named = [](const std::string& name) { return name == "m" ? std::string("k") : name; };
  if (const auto end = side_before(plain)) {
    if (*end == plain.size() && is_intrinsic_matrix(value)) return {plain, "k"};
    const std::string name = named(plain.substr(*end));
    if (is_of_camera(name, value, false)) return {plain.substr(0, *end), name};
  }
  if (const auto begin = side_after(plain)) {
    const std::string name = named(plain.substr(0, *begin));
    const bool is_numbered = std::isdigit(static_cast<unsigned char>(plain.back())) != 0;
    if (is_of_camera(name, value, is_numbered)) return {plain.substr(*begin), name};
  }
  return {};
}

bool has_intrinsics(const json& camera) { return CameraFields(camera, "", "").has_intrinsics(); }

}  // namespace

json split_stereo_pair(const json& fields) {
  std::map<std::string, json> cameras;
  json others = json::object();
  for (const auto& [key, value] : fields.items()) {
    const SidedName sided = sided_name(key, value);
    if (sided.side.empty())
      others[key] = value;
    else
      cameras[sided.side][sided.name] = value;
  }
  std::size_t complete = 0;
  for (const auto& [side, camera] : cameras) complete += has_intrinsics(camera);
  if (complete == 0 || (complete == 1 && has_intrinsics(fields))) return nullptr;
  // ORB-SLAM: the camera of the rectified images beside those of the images.
  json all = has_intrinsics(others) ? json{{"main", others}} : others;
  for (const auto& [side, camera] : cameras) all[side] = camera;
  return all;
}

}  // namespace edgescout
