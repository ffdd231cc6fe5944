#include "host/io/camera_file.h"

#include <yaml-cpp/yaml.h>

#include <cmath>
#include <optional>

#include "host/io/camera_json.h"
#include "host/io/files.h"
#include "kernels/error.h"

namespace edgescout {

namespace {

// Returns the field under the first of several names that exists: programs that write OpenCV YAML
// use different names.
YAML::Node any_of(const YAML::Node& root, std::initializer_list<const char*> names) {
  for (const char* name : names)
    if (const YAML::Node node = root[name]) return node;
  return YAML::Node(YAML::NodeType::Undefined);
}

// Reads a number, or lists of numbers with at most `depth` levels. The limit is needed since an
// alias can make a list an element of itself.
void flatten(const YAML::Node& node, int depth, std::vector<double>& numbers) {
  if (node.IsSequence() && depth > 0)
    for (const YAML::Node& element : node) flatten(element, depth - 1, numbers);
  else
    numbers.push_back(node.as<double>());
}

// Reads a matrix as ROS and OpenCV write it (rows, cols, data), or as plain or nested lists.
std::vector<double> matrix_numbers(const YAML::Node& node, const std::string& source,
                                   const char* field) {
  if (!node) throw InputError(source, field, "nothing", "a matrix");
  std::vector<double> numbers;
  try {
    constexpr int rows_of_numbers = 2;
    flatten(node.IsMap() ? node["data"] : node, rows_of_numbers, numbers);
  } catch (const YAML::Exception&) {
    throw InputError(source, field, "something else than numbers", "a matrix");
  }
  for (double x : numbers)
    if (!std::isfinite(x))
      throw InputError(source, field, "a value that is not finite", "finite numbers");
  return numbers;
}

int image_side(const YAML::Node& node, const std::string& source, const char* field) {
  if (!node) return 0;
  try {
    return node.as<int>();
  } catch (const YAML::Exception&) {
    throw InputError(source, field, "something else than a whole number", "an image size in px");
  }
}

void set_distortion_model(Camera& camera, const YAML::Node& root, const std::string& source) {
  const YAML::Node node =
      any_of(root, {"distortion_coefficients", "dist_coeffs", "distCoeffs", "distortion", "D"});
  const std::string model =
      root["distortion_model"] ? root["distortion_model"].as<std::string>("?") : "";
  if (!model.empty() && model != "plumb_bob" && model != "rational_polynomial" && model != "none")
    throw InputError(source, "distortion_model", model, "plumb_bob or rational_polynomial");
  if (!node && model != "none" && !model.empty())
    throw InputError(source, "distortion_coefficients", "nothing", "the coefficients of " + model);
  if (node)
    set_distortion(camera, matrix_numbers(node, source, "distortion_coefficients"), source,
                   "distortion_coefficients");
}

Camera camera_from_yaml(const YAML::Node& root, const std::string& source) {
  if (!root.IsMap()) throw InputError(source, "YAML", "no fields", "a camera calibration");
  Camera camera;
  camera.width =
      image_side(any_of(root, {"image_width", "imageWidth", "width"}), source, "image_width");
  camera.height =
      image_side(any_of(root, {"image_height", "imageHeight", "height"}), source, "image_height");
  const YAML::Node k = any_of(root, {"camera_matrix", "cameraMatrix", "Camera_Matrix", "K"});
  set_intrinsics(camera, matrix_numbers(k, source, "camera_matrix"), source, "camera_matrix");
  set_distortion_model(camera, root, source);
  return camera;
}

Camera camera_from_json(const std::filesystem::path& file) {
  const nlohmann::json content = read_json(file);
  const JsonField root{content, file.string(), ""};
  constexpr const char* forms =
      "fx, fy, cx, cy, width and height (BOP's camera.json), or cam_K, or an entry with cam_K for "
      "each image "
      "(scene_camera.json)";
  if (!content.is_object()) root.fail("no fields", forms);
  for (const char* name : {"fx", "fy", "cx", "cam_K"})
    if (root.has(name)) return camera_from_bop(root);
  std::optional<Camera> common;
  for (const auto& [id, value] : content.items()) {
    if (!value.is_object()) root.fail("a field \"" + id + "\"", forms);
    const Camera camera = camera_from_bop(root.at(id));
    if (common && !same_intrinsics(camera, *common))
      root.at(id).fail("a camera unlike the images' before",
                       "one camera (give the scene's folder to use one for each image)");
    common = camera;
  }
  if (!common) root.fail("no camera", forms);
  return *common;
}

}  // namespace

Camera load_camera(const std::filesystem::path& file) {
  const std::string source = file.string();
  Camera camera;
  if (file.extension() == ".json") {
    camera = camera_from_json(file);
  } else {
    try {
      camera = camera_from_yaml(YAML::Load(read_file(file)), source);
    } catch (const YAML::Exception& error) {
      throw InputError(source, "YAML", error.what(), "a ROS or OpenCV camera calibration");
    }
  }
  if ((camera.width == 0) != (camera.height == 0))
    throw InputError(source, camera.width ? "image_height" : "image_width", "nothing",
                     "both sizes or neither");
  // Without a size in the file, the principal point is checked when the image's size is known.
  Camera checked = camera;
  if (camera.width == 0) checked.width = checked.height = 1 << 20;
  validate(checked, source);
  return camera;
}

Camera camera_for_image(const Camera& calibration, int width, int height, bool allow_scale,
                        const std::string& source) {
  Camera camera = calibration;
  camera.width = width;
  camera.height = height;
  if (calibration.width != 0 && (calibration.width != width || calibration.height != height)) {
    const double x = static_cast<double>(width) / calibration.width,
                 y = static_cast<double>(height) / calibration.height;
    const auto size = [](int w, int h) { return std::to_string(w) + "x" + std::to_string(h); };
    const bool pure_scale = std::abs(x / y - 1) <= 0.005;
    if (!pure_scale || !allow_scale)
      throw InputError(source, "image size", size(width, height),
                       "the calibration's " + size(calibration.width, calibration.height) +
                           (pure_scale ? " (a pure scale: allow it with --scale-camera)" : ""));
    // Each axis has its own factor, since the image's size is rounded. See scaled() for the half
    // pixels.
    camera.fx *= x;
    camera.fy *= y;
    camera.cx = x * (camera.cx + 0.5) - 0.5;
    camera.cy = y * (camera.cy + 0.5) - 0.5;
  }
  validate(camera, source);
  return camera;
}

}  // namespace edgescout
