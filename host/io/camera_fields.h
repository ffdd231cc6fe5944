// Internal to host/io: the fields of one camera in a tree (camera_tree.h), found by the names that
// programs give them.
#pragma once

#include <functional>
#include <initializer_list>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "host/io/json_fields.h"

namespace edgescout {

// "Camera_Matrix", "cameraMatrix" and "camera matrix" are one name: "cameramatrix".
std::string plain_name(std::string_view name);

// Readers of values. InputError naming the field.
double number_in_field(const JsonField& field);  // finite; also in quotes
int whole_number_in_field(const JsonField& field);
std::vector<double> numbers_in_field(const JsonField& field);  // number, lists, OpenCV's matrix
std::string text_in_field(const JsonField& field);

// Whether nothing is lost without the field: null, false, zeros, an empty list or word, "none".
bool is_trivial(const nlohmann::json& value);
// Whether the value holds numbers: a list, a matrix with `data`, or a text of several numbers.
bool is_list(const nlohmann::json& value);

// Which of several words a plain name holds, and where.
bool is_any_of(std::string_view name, std::initializer_list<std::string_view> names);
bool contains_any_of(std::string_view name, std::initializer_list<std::string_view> parts);
bool is_matrix_name(std::string_view name);      // of the intrinsic matrix
bool is_distortion_name(std::string_view name);  // of the list of coefficients
// "k1", "k_1", "radial_k1" -> "k1". Empty: no coefficient.
std::string coefficient_name(std::string_view name);

// Whether a field of this plain name and value, which no reader took, changes where a point is seen
// or what image the calibration is for: a lens, a region, binning, a turned image. Not if it is
// trivial.
bool changes_the_image(std::string_view name, const nlohmann::json& value);
// The field, or one within it, that does. What a camera of its own or a pose holds is not searched.
std::optional<JsonField> field_that_changes_the_image(const JsonField& field, int depth = 0);

class CameraFields {
 public:
  // Objects within whose name says that they hold a part of the camera (`intrinsics`,
  // `distortion`, ..) count as part of this one. `outer` are the fields of what the camera stands
  // in; they count where the camera has none of their name. The value must outlive the object.
  CameraFields(const nlohmann::json& object, const std::string& source, const std::string& path,
               const std::vector<JsonField>& outer = {});

  const std::string& source() const { return source_; }
  const std::string& path() const { return path_; }
  std::string at(const std::string& field) const;  // its path, for errors

  bool has_intrinsics() const;  // in any form
  bool has(std::initializer_list<std::string_view> names) const;
  bool has_spelt(std::string_view name) const;  // letter by letter

  // Returns the field and marks it as read. Null counts as absent. InputError: two of the names
  // stand with values that differ.
  std::optional<JsonField> take(std::initializer_list<std::string_view> names);
  // All fields whose plain name and value fit.
  std::vector<JsonField> take_all(
      const std::function<bool(std::string_view, const nlohmann::json&)>& fits);
  // Those that are not read and fit; they stay so.
  std::vector<JsonField> find_all(
      const std::function<bool(std::string_view, const nlohmann::json&)>& fits) const;
  // Names of the fields that are not read.
  std::vector<std::string> unread() const;
  // InputError: a field that is not read looks like distortion, a lens model or a region of the
  // image.
  void require_all_understood() const;

 private:
  struct Entry {
    std::string name;     // plain
    std::string written;  // as spelt
    std::string path;
    const nlohmann::json* value;
    bool in_distortion;  // in an object that holds the distortion
    bool is_read = false;
  };
  void add(const nlohmann::json& object, const std::string& path, bool in_distortion, int depth);

  std::string source_, path_;
  std::vector<Entry> entries_;
};

}  // namespace edgescout
