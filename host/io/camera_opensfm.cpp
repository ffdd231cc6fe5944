// Cameras of OpenSfM: focal lengths and the distance of the principal point from the middle of the
// image, in parts of its longer side.
#include <algorithm>
#include <cmath>
#include <map>

#include "host/io/camera_programs.h"

namespace edgescout {

using nlohmann::json;

namespace {

// The coefficients of these names; those that are missing are 0.
std::vector<double> coefficients_at(const JsonField& object,
                                    const std::vector<std::string>& names) {
  std::vector<double> values;
  for (const std::string& name : names)
    values.push_back(object.has(name) ? number_at(object, name) : 0);
  return values;
}

const std::map<std::string, std::pair<const char*, std::vector<std::string>>, std::less<>>
    opensfm_models{{"perspective", {"plumb_bob", {"k1", "k2"}}},
                   {"simple_radial", {"plumb_bob", {"k1"}}},
                   {"radial", {"plumb_bob", {"k1", "k2"}}},
                   {"brown", {"plumb_bob", {"k1", "k2", "p1", "p2", "k3"}}},
                   {"fisheye", {"fisheye", {"k1", "k2"}}},
                   {"fisheye_opencv", {"fisheye", {"k1", "k2", "k3", "k4"}}},
                   {"fisheye62", {"fisheye", {"k1", "k2", "k3", "k4", "k5", "k6"}}},
                   {"fisheye624", {"fisheye", {"k1", "k2", "k3", "k4", "k5", "k6"}}}};

bool is_opensfm_camera(const json& value) {
  if (!value.is_object() || !value.contains("projection_type") ||
      !value["projection_type"].is_string())
    return false;
  const std::string type = value["projection_type"];
  if (value.contains("width") && is_any_of(type, {"spherical", "equirectangular", "dual"}))
    return true;
  constexpr double most_parts = 20;  // a view of 3 degrees
  const auto is_part = [&](const char* name) {
    return value.contains(name) && value[name].is_number() && value[name] < most_parts;
  };
  return is_part("focal") || is_part("focal_x");
}

// A fisheye camera of OpenSfM with tangential coefficients: their order is not Project Aria's.
void require_no_tangential(const JsonField& camera) {
  for (const char* name : {"p1", "p2", "s0", "s1", "s2", "s3"})
    if (camera.has(name) && number_at(camera, name) != 0)
      camera.at(name).fail(
          camera.value[name].dump() + " of OpenSfM's model " + camera.at("projection_type").text(),
          "0, or a calibration with OpenSfM's model fisheye_opencv");
}

void set_from_opensfm(const JsonField& camera, json& read) {
  const double width = number_at(camera, "width"), height = number_at(camera, "height");
  const double side = std::max(width, height);
  const bool has_axes = camera.has("focal_x");
  read["fx"] = side * number_at(camera, has_axes ? "focal_x" : "focal");
  read["fy"] = side * number_at(camera, has_axes ? "focal_y" : "focal");
  // OpenSfM has the corner of the first pixel at 0, 0.
  for (const auto& [name, written, length] :
       {std::tuple{"cx", "c_x", width}, {"cy", "c_y", height}}) {
    const double part = camera.has(written) ? number_at(camera, written) : 0;
    if (std::abs(part) > 1)
      camera.at(written).fail(camera.value[written].dump(),
                              "a part of the longer side of the image, as OpenSfM writes it");
    read[name] = side * part + (length - 1) / 2;
  }
}

json opensfm_camera(const JsonField& camera) {
  const std::string type = camera.at("projection_type").text();
  const auto model = opensfm_models.find(type);
  if (model == opensfm_models.end())
    camera.at("projection_type")
        .fail("a calibration of OpenSfM, model " + type,
              "OpenSfM's perspective, simple_radial, radial, brown, fisheye or fisheye_opencv");
  const auto& [word, names] = model->second;
  const bool is_fisheye = word == std::string("fisheye");
  if (is_fisheye) require_no_tangential(camera);
  json read = camera.value;  // what is not read stays, and is judged as in other files
  for (const char* name : {"projection_type", "focal", "focal_x", "focal_y", "c_x", "c_y", "p1",
                           "p2", "s0", "s1", "s2", "s3"})
    read.erase(name);
  for (const std::string& name : names) read.erase(name);
  set_from_opensfm(camera, read);
  read["distortion_model"] = word;
  std::vector<double> coefficients = coefficients_at(camera, names);
  if (coefficients.size() < 4) coefficients.resize(4);
  read["D"] = coefficients;
  return read;
}

}  // namespace

bool is_of_opensfm(const json& tree) {
  if (is_opensfm_camera(tree)) return true;
  if (tree.is_object()) return !tree.empty() && std::ranges::all_of(tree, is_opensfm_camera);
  return tree.is_array() && !tree.empty() && std::ranges::all_of(tree, [](const json& part) {
           return part.is_object() && part.contains("cameras") && part["cameras"].is_object() &&
                  !part["cameras"].empty() &&
                  std::ranges::all_of(part["cameras"], is_opensfm_camera);
         });
}

json opensfm_cameras(const JsonField& tree) {
  if (is_opensfm_camera(tree.value)) return opensfm_camera(tree);
  json cameras = tree.value.is_array() ? json::array() : json::object();
  for (const auto& [key, value] : tree.value.items()) {
    const JsonField field{value, tree.source, tree.path.empty() ? key : tree.path + "/" + key};
    const bool is_reconstruction = tree.value.is_array() && field.has("cameras");
    if (is_opensfm_camera(value))
      cameras[key] = opensfm_camera(field);
    else if (is_reconstruction)
      cameras.push_back(opensfm_cameras(field.at("cameras")));
  }
  return cameras;
}

}  // namespace edgescout
