// The camera parameters of HALCON: a file of write_cam_par (.cal, .dat), or the tuple as HDevelop
// shows it. Lengths of the sensor are in m. HALCON's coefficients take the distortion away, so
// cameras with a lens are refused.
#include <algorithm>

#include "host/core/words.h"
#include "host/io/camera_fields.h"
#include "host/io/camera_tree.h"
#include "kernels/error.h"

namespace edgescout {

using nlohmann::json;

namespace {

constexpr const char* halcon_export =
    "one without distortion: change_radial_distortion_cam_par and change_radial_distortion_image "
    "make it and its images";

[[noreturn]] void refuse_halcon(const std::string& source, const std::string& field,
                                const std::string& found) {
  throw InputError(source, field, "a calibration of HALCON, " + found, halcon_export);
}

// "Focus:foc: 0.008;" -> the name and the value. The lines of its type and of its description have
// another form.
std::pair<std::string, std::string> halcon_parameter(const std::string& line) {
  const std::size_t first = line.find(':'), second = line.find(':', first + 1);
  if (line.starts_with('"') || first == std::string::npos || second == std::string::npos) return {};
  const std::string name = trimmed(std::string_view(line).substr(0, first));
  if (is_any_of(name, {"DOUBLE", "INT", "STRING", "ParGroup"})) return {};
  const std::size_t end = std::min(line.find(';', second), line.size());
  return {name, trimmed(std::string_view(line).substr(second + 1, end - second - 1))};
}

json halcon_file(const std::vector<std::string>& lines, const std::string& source) {
  const auto is_group = [](const std::string& line) { return line.starts_with("ParGroup:"); };
  if (std::ranges::none_of(lines, is_group)) return nullptr;
  json parameters = json::object();
  for (const std::string& line : lines) {
    if (is_group(line) && line.find("Line") != std::string::npos)
      refuse_halcon(source, "ParGroup", "a line scan camera");
    const auto& [name, value] = halcon_parameter(line);
    if (!name.empty()) add_field(parameters, name, scalar_of(value), source);
  }
  return parameters;
}

// "['area_scan_division', 0.008, -2253.5, ..]"
json halcon_tuple(const std::vector<std::string>& lines, const std::string& source) {
  std::string all;
  for (const std::string& line : lines) all += line + " ";
  const std::vector<std::string> words = words_of(all, " \t,;[]()'\"");
  if (words.empty() || !(words[0].starts_with("area_scan_") || words[0].starts_with("line_scan_")))
    return nullptr;
  std::vector<std::string> names{"Focus", "Kappa"};
  if (words[0] == "area_scan_polynomial")
    names = {"Focus", "Poly1", "Poly2", "Poly3", "Poly4", "Poly5"};
  else if (words[0] != "area_scan_division")
    refuse_halcon(source, "camera type", words[0]);
  for (const char* name : {"Sx", "Sy", "Cx", "Cy", "ImageWidth", "ImageHeight"})
    names.emplace_back(name);
  if (words.size() != names.size() + 1)
    throw InputError(source, words[0], std::to_string(words.size() - 1) + " parameters",
                     std::to_string(names.size()));
  json parameters = json::object();
  for (std::size_t i = 0; i < names.size(); ++i) parameters[names[i]] = scalar_of(words[i + 1]);
  return parameters;
}

void require_halcon_pinhole(const json& parameters, const std::string& source) {
  for (const auto& [name, value] : parameters.items()) {
    if (is_any_of(name, {"Focus", "Sx", "Sy", "Cx", "Cy", "ImageWidth", "ImageHeight"})) continue;
    const bool is_type =
        plain_name(name) == "cameratype" && value.is_string() &&
        is_any_of(value.get<std::string>(), {"area_scan_division", "area_scan_polynomial"});
    if (is_type || (value.is_number() && value == 0)) continue;
    const std::string model = name == "Kappa"            ? "division model"
                              : name.starts_with("Poly") ? "polynomial model"
                                                         : "parameter " + name;
    refuse_halcon(source, name,
                  model + " (" + value.dump(-1, ' ', false, json::error_handler_t::replace) + ")");
  }
}

double halcon_number(const json& parameters, const std::string& name, const std::string& source) {
  const double number = number_in_field(JsonField{parameters, source, ""}.at(name));
  if (number <= 0 && !is_any_of(name, {"Cx", "Cy"}))
    refuse_halcon(source, name,
                  name == "Focus" ? "a telecentric lens" : "a value that is not above 0");
  return number;
}

}  // namespace

json halcon_camera(const std::vector<std::string>& lines, const std::string& source) {
  json parameters = halcon_file(lines, source);
  if (parameters.is_null()) parameters = halcon_tuple(lines, source);
  if (parameters.is_null()) return nullptr;
  require_halcon_pinhole(parameters, source);
  const auto number = [&](const char* name) { return halcon_number(parameters, name, source); };
  const double focus_m = number("Focus");
  return {{"fx", focus_m / number("Sx")},
          {"fy", focus_m / number("Sy")},
          {"cx", number("Cx")},
          {"cy", number("Cy")},
          {"width", number("ImageWidth")},
          {"height", number("ImageHeight")}};
}

}  // namespace edgescout
