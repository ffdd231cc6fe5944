// Cameras of OpenSfM, AliceVision (Meshroom) and Project Aria, whose files measure lengths in parts
// of the image or in mm, or name the size of the image by the sensor alone.
#include <algorithm>
#include <array>
#include <cmath>
#include <map>

#include "host/io/camera_reader.h"
#include "host/io/camera_tree.h"
#include "kernels/error.h"

namespace edgescout {

using nlohmann::json;

namespace {

double double_at(const JsonField& object, const std::string& name) {
  return number_in_field(object.at(name));
}

// The coefficients of these names; those that are missing are 0.
std::vector<double> coefficients_at(const JsonField& object,
                                    const std::vector<std::string>& names) {
  std::vector<double> values;
  for (const std::string& name : names)
    values.push_back(object.has(name) ? double_at(object, name) : 0);
  return values;
}

// --- OpenSfM: focal lengths and the distance of the principal point from the middle of the image,
// in parts of its longer side.

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
    if (camera.has(name) && double_at(camera, name) != 0)
      camera.at(name).fail(
          camera.value[name].dump() + " of OpenSfM's model " + camera.at("projection_type").text(),
          "0, or a calibration with OpenSfM's model fisheye_opencv");
}

void set_from_opensfm(const JsonField& camera, json& read) {
  const double width = double_at(camera, "width"), height = double_at(camera, "height");
  const double side = std::max(width, height);
  const bool has_axes = camera.has("focal_x");
  read["fx"] = side * double_at(camera, has_axes ? "focal_x" : "focal");
  read["fy"] = side * double_at(camera, has_axes ? "focal_y" : "focal");
  // OpenSfM has the corner of the first pixel at 0, 0.
  for (const auto& [name, written, length] :
       {std::tuple{"cx", "c_x", width}, {"cy", "c_y", height}}) {
    const double part = camera.has(written) ? double_at(camera, written) : 0;
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

// The tree with its cameras of OpenSfM read; poses and points are left out.
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

bool is_of_opensfm(const json& tree) {
  if (is_opensfm_camera(tree)) return true;
  if (tree.is_object()) return !tree.empty() && std::ranges::all_of(tree, is_opensfm_camera);
  return tree.is_array() && !tree.empty() && std::ranges::all_of(tree, [](const json& part) {
           return part.is_object() && part.contains("cameras") && part["cameras"].is_object() &&
                  !part["cameras"].empty() &&
                  std::ranges::all_of(part["cameras"], is_opensfm_camera);
         });
}

// --- AliceVision: focal lengths and sensors in mm, the principal point from the middle.

using AliceVersion = std::array<int, 3>;

AliceVersion alice_version(const JsonField& root) {
  AliceVersion version{};
  const std::vector<double> numbers = numbers_in_field(root.at("version"));
  if (numbers.size() != version.size())
    root.at("version").fail(std::to_string(numbers.size()) + " numbers",
                            "the 3 of AliceVision's version");
  for (std::size_t i = 0; i < version.size(); ++i)
    version[i] = whole_number_in_field({json(numbers[i]), root.source, root.path + "version"});
  return version;
}

// The versions of the format differ in units and in what the ratio of the pixels' sides divides.
void set_alice_pinhole(const JsonField& camera, const AliceVersion& version, json& read) {
  const double width = double_at(camera, "width"), height = double_at(camera, "height");
  double fx = 0, fy = 0;
  if (version < AliceVersion{1, 2, 2}) {
    const std::vector<double> focal = numbers_in_field(camera.at("pxFocalLength"));
    if (focal.empty() || focal.size() > 2)
      camera.at("pxFocalLength").fail(std::to_string(focal.size()) + " numbers", "1 or 2");
    fx = focal.front(), fy = focal.back();
  } else {
    const double ratio = camera.has("pixelRatio") ? double_at(camera, "pixelRatio") : 1;
    fx = double_at(camera, "focalLength") / double_at(camera, "sensorWidth") * width;
    fy = version < AliceVersion{1, 2, 5} ? fx / ratio : fx * ratio;
  }
  const std::vector<double> point = numbers_in_field(camera.at("principalPoint"));
  if (point.size() != 2)
    camera.at("principalPoint").fail(std::to_string(point.size()) + " numbers", "2");
  const bool is_from_corner = version < AliceVersion{1, 2, 1};
  read["fx"] = fx;
  read["fy"] = fy;
  read["cx"] = point[0] + (is_from_corner ? 0 : width / 2);
  read["cy"] = point[1] + (is_from_corner ? 0 : height / 2);
  read["width"] = width;
  read["height"] = height;
}

struct AliceLens {
  const char* word;
  std::vector<std::size_t> places;  // of each coefficient in the order of the model
};
const std::map<std::string, AliceLens, std::less<>> alice_lenses{
    {"pinhole", {"pinhole", {}}},
    {"none", {"pinhole", {}}},
    {"radial1", {"plumb_bob", {0}}},
    {"radialk1", {"plumb_bob", {0}}},
    {"radial3", {"plumb_bob", {0, 1, 4}}},
    {"radialk3", {"plumb_bob", {0, 1, 4}}},
    {"brown", {"plumb_bob", {0, 1, 4, 2, 3}}},
    {"fisheye4", {"fisheye", {0, 1, 2, 3}}},
    {"fisheye", {"fisheye", {0, 1, 2, 3}}},
    {"fisheye1", {"fov", {0}}}};

void set_alice_lens(const JsonField& camera, json& read) {
  const JsonField type = camera.at("type");
  // Later versions keep the projection and the distortion apart.
  const bool is_apart = camera.has("distortionType") && type.text() == "pinhole";
  const JsonField named = is_apart ? camera.at("distortionType") : type;
  const auto lens = alice_lenses.find(named.text());
  if (lens == alice_lenses.end())
    named.fail("a calibration of AliceVision, model " + named.text(),
               "AliceVision's pinhole, radial1, radial3, brown, fisheye4 or fisheye1");
  const JsonField list = camera.at("distortionParams");
  const std::vector<double> written =
      is_trivial(list.value) ? std::vector<double>{} : numbers_in_field(list);
  const std::vector<std::size_t>& places = lens->second.places;
  if (written.size() > places.size() || (!written.empty() && written.size() < places.size()))
    list.fail(std::to_string(written.size()) + " coefficients",
              std::to_string(places.size()) + " of AliceVision's model " + named.text());
  std::vector<double> ordered(lens->second.word == std::string("fov") ? 1 : 5);
  for (std::size_t i = 0; i < written.size(); ++i) ordered[places[i]] = written[i];
  read["distortion_model"] = written.empty() ? "pinhole" : lens->second.word;
  read["D"] = ordered;
}

json alice_camera(const JsonField& camera, const AliceVersion& version) {
  for (const auto& [key, value] : camera.value.items()) {
    const bool is_known =
        is_any_of(key, {"type", "distortionType", "distortionParams", "distortionLocked",
                        "distortionInitializationMode", "principalPoint", "undistortionType"});
    if (!is_known && changes_the_image(plain_name(key), value))
      camera.at(key).fail("a value of AliceVision", "0 or nothing");
  }
  json read = json::object();
  set_alice_pinhole(camera, version, read);
  set_alice_lens(camera, read);
  return read;
}

bool is_of_alicevision(const json& tree) {
  return tree.is_object() && tree.contains("intrinsics") && tree["intrinsics"].is_array() &&
         !tree["intrinsics"].empty() &&
         std::ranges::all_of(tree["intrinsics"], [](const json& camera) {
           return camera.is_object() && camera.contains("intrinsicId");
         });
}

json alice_cameras(const JsonField& root) {
  const AliceVersion version = alice_version(root);
  json cameras = json::object();
  for (const json& camera : root.value["intrinsics"]) {
    const std::string name = text_in_field({camera["intrinsicId"], root.source, "intrinsicId"});
    add_field(cameras, name, alice_camera({camera, root.source, "intrinsics/" + name}, version),
              root.source);
  }
  return cameras;
}

// --- Project Aria: the factory calibration of a recording. The label of a camera says its size.

bool is_of_aria(const json& tree) {
  return tree.is_object() && tree.contains("CameraCalibrations") &&
         tree["CameraCalibrations"].is_array();
}

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

}  // namespace

json with_common_fields(json tree, const std::string& source) {
  const JsonField root{tree, source, ""};
  if (is_of_opensfm(tree)) return opensfm_cameras(root);
  if (is_of_alicevision(tree)) return alice_cameras(root);
  if (is_of_aria(tree)) return aria_cameras(root);
  return tree;
}

std::optional<std::string> program_that_is_not_read(const std::string& text) {
  constexpr std::pair<std::string_view, const char*> marks[] = {
      {"<projection>frame", "Agisoft Metashape"},
      {"capturingreality.com", "RealityCapture"},
      {"# Bundle file", "Bundler"},
      {"calibu_", "Calibu"},
      {"# kapture format", "kapture"},
      {"coefficients for the DIRECT mapping", "OCamCalib (Scaramuzza's model)"}};
  for (const auto& [mark, program] : marks)
    if (text.find(mark) != std::string::npos) return program;
  return {};
}

}  // namespace edgescout
