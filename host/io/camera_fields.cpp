#include "host/io/camera_fields.h"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <set>

#include "host/io/camera_tree.h"
#include "kernels/error.h"

namespace edgescout {

using nlohmann::json;

namespace {

std::string shown(const json& value) {
  return value.dump(-1, ' ', false, json::error_handler_t::replace).substr(0, 60);
}

void flatten(const JsonField& field, const json& value, int depth, std::vector<double>& numbers) {
  if (value.is_array() && depth > 0) {
    for (const json& element : value) flatten(field, element, depth - 1, numbers);
    return;
  }
  const json number = value.is_string() ? scalar_of(value.get<std::string>()) : value;
  if (!number.is_number()) field.fail(shown(value), "numbers");
  if (!std::isfinite(number.get<double>()))
    field.fail("a value that is not finite", "finite numbers");
  numbers.push_back(number.get<double>());
}

// Coefficients that take the distortion away are no coefficients that distort.
bool is_inverse_distortion(std::string_view name) {
  return contains_any_of(name, {"undistort", "invdist", "distinv", "distortioninv"}) ||
         (name.find("inverse") != std::string_view::npos &&
          contains_any_of(name, {"dist", "coef", "lens"}));
}

// Objects that are no part of a camera's intrinsics are other cameras, or of no interest.
bool is_part_of_camera(std::string_view name) {
  if (is_inverse_distortion(name)) return false;
  return is_matrix_name(name) || is_distortion_name(name) ||
         contains_any_of(name, {"intrinsic", "distortion", "projectionparam", "resolution"}) ||
         is_any_of(name, {"calibration",    "calib",         "camera",      "camerainfo",
                          "cameramodel",    "cammodel",      "imagesize",   "capturedimagesize",
                          "size",           "image",         "parameters",  "params",
                          "principalpoint", "opticalcenter", "focallength", "focal",
                          "binning",        "lens",          "value",       "value0"});
}

bool is_camera_number(std::string_view name) {
  return is_any_of(name, {"fx", "fy", "cx", "cy", "width", "height", "k1", "k2", "k3", "p1", "p2",
                          "d0", "d1", "d2", "d3", "d4"});
}

// "cam_fx", "cam_width", "cam_d0" of vikit; "fx_px".
std::string without_camera(const std::string& name) {
  for (const std::string_view prefix : {"camera", "cam"})
    if (name.starts_with(prefix) && is_camera_number(name.substr(prefix.size())))
      return name.substr(prefix.size());
  if (name.ends_with("px") && is_camera_number(name.substr(0, name.size() - 2)))
    return name.substr(0, name.size() - 2);
  return name;
}

// "focal_length: {x: 700, y: 701}".
std::string with_axis(const std::string& name, std::string_view object) {
  if (!is_any_of(name, {"x", "y"})) return name;
  if (is_any_of(object, {"focallength", "focal"})) return "f" + name;
  return is_any_of(object, {"principalpoint", "opticalcenter"}) ? "c" + name : name;
}

// What a list of coefficients has beside it, rather than another coefficient.
bool is_about_coefficients(std::string_view name) {
  return contains_any_of(
             name, {"err",  "rms",   "residual", "std",   "cov",    "variance",   "sigma",
                    "num",  "count", "size",     "width", "height", "resolution", "version",
                    "time", "date",  "fov",      "max",   "min",    "valid",      "radius"}) ||
         is_any_of(name, {"n", "id", "rows", "cols"});
}

std::string path_below(const std::string& path, const std::string& name) {
  return path.empty() ? name : path + "/" + name;
}

}  // namespace

std::string plain_name(std::string_view name) {
  std::string plain;
  for (const unsigned char c : name)
    if (std::isalnum(c)) plain += char(std::tolower(c));
  return plain;
}

double number_in_field(const JsonField& field) {
  std::vector<double> numbers;
  flatten(field, field.value, 1, numbers);
  if (numbers.size() != 1) field.fail(shown(field.value), "a number");
  return numbers[0];
}

int whole_number_in_field(const JsonField& field) {
  const double x = number_in_field(field);
  if (x != std::floor(x) || std::abs(x) > 2e9) field.fail(shown(field.value), "a whole number");
  return static_cast<int>(x);
}

std::vector<double> numbers_in_field(const JsonField& field) {
  constexpr int rows_of_numbers = 3;  // Python's array of an array of a row
  std::vector<double> numbers;
  const bool is_matrix = field.value.is_object();
  if (is_matrix && !field.value.contains("data")) field.fail("an object without data", "numbers");
  const json& content = is_matrix ? field.value["data"] : field.value;
  const json in_text = content.is_string() ? numbers_in(content.get<std::string>()) : json(nullptr);
  flatten(field, in_text.is_null() ? content : in_text, rows_of_numbers, numbers);
  return numbers;
}

std::string text_in_field(const JsonField& field) {
  if (field.value.is_string()) return field.value.get<std::string>();
  if (field.value.is_number() || field.value.is_boolean()) return shown(field.value);
  field.fail(shown(field.value), "a word");
}

bool is_trivial(const json& value) {
  if (value.is_null() || (value.is_boolean() && !value.get<bool>())) return true;
  if (value.is_number()) return value.get<double>() == 0;
  if (value.is_string())
    return is_any_of(plain_name(value.get<std::string>()), {"", "none", "no", "off", "false", "0"});
  if (value.is_object() && value.contains("data")) return is_trivial(value["data"]);
  return value.is_structured() && std::ranges::all_of(value, is_trivial);
}

bool is_list(const json& value) {
  if (value.is_object()) return value.contains("data");
  if (value.is_string()) {
    const json numbers = numbers_in(value.get<std::string>());
    return numbers.is_array() && numbers.size() > 1;
  }
  return value.is_array() && (value.empty() || std::ranges::none_of(value, [](const json& x) {
                                return x.is_object();
                              }));
}

bool is_any_of(std::string_view name, std::initializer_list<std::string_view> names) {
  return std::ranges::find(names, name) != names.end();
}

bool contains_any_of(std::string_view name, std::initializer_list<std::string_view> parts) {
  return std::ranges::any_of(
      parts, [&](std::string_view part) { return name.find(part) != std::string_view::npos; });
}

bool is_matrix_name(std::string_view name) {
  if (name.starts_with("new") || name.starts_with("optimal") || name.starts_with("rect"))
    return false;  // of an image that was undistorted
  return is_any_of(name, {"k", "kk", "camk", "mtx", "matrix", "kmatrix", "kmat", "matrixk", "kmtx",
                          "cameramtx", "cammtx", "calibrationmatrix"}) ||
         contains_any_of(name, {"cameramat", "cammat", "intrinsic"});
}

bool is_distortion_name(std::string_view name) {
  if (is_inverse_distortion(name)) return false;
  if (contains_any_of(name,
                      {"model", "type", "distance", "distrib", "distro", "radial", "tangential"}) ||
      name.starts_with("est"))
    return false;
  return is_any_of(name, {"d", "coeffs", "coefficients", "coeff", "coefs", "coef", "dcoeffs",
                          "dcoefs", "dcoef", "kc"}) ||
         contains_any_of(name, {"distort", "distcoef"}) || name.starts_with("dist") ||
         name.ends_with("dist");
}

std::string coefficient_name(std::string_view name) {
  // What the SDK of Azure Kinect prints.
  if (name == "tangentialdistortioncoefficientx") return "p1";
  if (name == "tangentialdistortioncoefficienty") return "p2";
  for (const std::string_view prefix :
       {"camera", "cam", "distortion", "dist", "radial", "tangential", "prism", "lens"})
    if (name.starts_with(prefix)) name.remove_prefix(prefix.size());
  static const std::set<std::string, std::less<>> names{
      "k1", "k2",  "k3",  "k4",   "k5",   "k6", "p1", "p2", "s1", "s2", "s3",
      "s4", "sx1", "sy1", "taux", "tauy", "d0", "d1", "d2", "d3", "d4", "kud"};
  return names.contains(name) ? std::string(name) : "";
}

CameraFields::CameraFields(const json& object, const std::string& source, const std::string& path,
                           const std::vector<JsonField>& outer)
    : source_(source), path_(path) {
  add(object, path, false, 0);
  for (const JsonField& field : outer) {
    const std::string written = field.path.substr(field.path.rfind('/') + 1);
    const std::string name = plain_name(written);
    if (std::ranges::find(entries_, name, &Entry::name) == entries_.end())
      entries_.push_back({name, written, field.path, &field.value, false});
  }
}

void CameraFields::add(const json& object, const std::string& path, bool in_distortion, int depth) {
  if (!object.is_object()) return;
  for (const auto& [key, value] : object.items()) {
    std::string name = plain_name(key);
    std::string written = key;
    // ORB-SLAM's "Camera.fx", "Camera1.k1".
    if (const std::size_t dot = key.find('.');
        dot != std::string::npos && plain_name(key.substr(0, dot)).starts_with("camera"))
      name = plain_name(written = key.substr(dot + 1));
    name = with_axis(without_camera(name), plain_name(path.substr(path.rfind('/') + 1)));
    const std::string where = path_below(path, key);
    const bool is_matrix = value.is_object() && value.contains("data");
    if (value.is_object() && !is_matrix && depth < 4 && is_part_of_camera(name)) {
      add(value, where, in_distortion || is_distortion_name(name), depth + 1);
      continue;
    }
    if (in_distortion && is_any_of(name, {"params", "parameters", "values", "vector", "list"}))
      name = "distortion";
    entries_.push_back({name, written, where, &value, in_distortion});
  }
}

std::string CameraFields::at(const std::string& field) const { return path_below(path_, field); }

bool CameraFields::has_intrinsics() const {
  return std::ranges::any_of(
             entries_,
             [](const Entry& entry) {
               const bool is_value = !entry.value->is_null() && !entry.value->is_object();
               return (is_matrix_name(entry.name) && is_list(*entry.value) &&
                       !entry.value->empty()) ||
                      (is_any_of(entry.name,
                                 {"fx", "flx", "fu", "ppx", "mu", "focallength", "f", "fc",
                                  "focallengthx", "modelparameters", "projectionparams"}) &&
                       is_value);
             }) ||
         (has({"params"}) && has({"model"})) || (has({"px"}) && has({"u0"}));
}

bool CameraFields::has(std::initializer_list<std::string_view> names) const {
  return std::ranges::any_of(entries_, [&](const Entry& entry) {
    return is_any_of(entry.name, names) && !entry.value->is_null();
  });
}

bool CameraFields::has_spelt(std::string_view name) const {
  return std::ranges::find(entries_, name, &Entry::written) != entries_.end();
}

std::optional<JsonField> CameraFields::take(std::initializer_list<std::string_view> names) {
  const Entry* first = nullptr;
  for (Entry& entry : entries_) {
    if (!is_any_of(entry.name, names)) continue;
    entry.is_read = true;
    if (entry.value->is_null()) continue;
    if (first && *entry.value != *first->value)
      throw InputError(source_, entry.path, shown(*entry.value),
                       shown(*first->value) + " as in " + first->path);
    if (!first) first = &entry;
  }
  if (!first) return {};
  return JsonField{*first->value, source_, first->path};
}

std::vector<JsonField> CameraFields::take_all(
    const std::function<bool(std::string_view, const json&)>& fits) {
  std::vector<JsonField> fields;
  for (Entry& entry : entries_)
    if (!entry.is_read && !entry.value->is_null() && fits(entry.name, *entry.value)) {
      entry.is_read = true;
      fields.push_back({*entry.value, source_, entry.path});
    }
  return fields;
}

std::vector<JsonField> CameraFields::find_all(
    const std::function<bool(std::string_view, const json&)>& fits) const {
  std::vector<JsonField> fields;
  for (const Entry& entry : entries_)
    if (!entry.is_read && !entry.value->is_null() && fits(entry.name, *entry.value))
      fields.push_back({*entry.value, source_, entry.path});
  return fields;
}

std::vector<std::string> CameraFields::unread() const {
  std::vector<std::string> names;
  for (const Entry& entry : entries_)
    if (!entry.is_read) names.push_back(entry.path);
  return names;
}

void CameraFields::require_all_understood() const {
  for (const Entry& entry : entries_) {
    if (entry.is_read) continue;
    // Its own name: "Camera.k1" is k1.
    const JsonField field{*entry.value, source_, entry.path};
    std::optional<JsonField> found;
    const bool may_be_coefficient = entry.in_distortion &&
                                    (entry.value->is_number() || is_list(*entry.value)) &&
                                    !is_trivial(*entry.value) && !is_about_coefficients(entry.name);
    if (may_be_coefficient || changes_the_image(entry.name, *entry.value))
      found.emplace(field);
    else if (const auto within = field_that_changes_the_image(field); within)
      found.emplace(*within);
    if (found)
      found->fail(shown(found->value),
                  "a field that is understood: it looks like a lens or a part "
                  "of the image");
  }
}

}  // namespace edgescout
