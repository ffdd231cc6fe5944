// Internal to host: reads JSON files, with errors that name the file and the field.
#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "host/core/se3.h"
#include "host/io/rotations.h"

namespace edgescout {

// InputError: the text is no JSON, or an object in it has a field twice.
nlohmann::json parse_json(const std::string& text, const std::string& source,
                          bool allow_comments = false);

// InputError: also where the file is missing or holds no JSON object or array.
nlohmann::json read_json(const std::filesystem::path& file);

// A value of a JSON file and its place, which errors name: "FILE: /3/cam_K".
struct JsonField {
  const nlohmann::json& value;
  std::string source;  // the file
  std::string path;    // where in the file

  bool has(const std::string& name) const { return value.is_object() && value.contains(name); }
  JsonField at(const std::string& name) const;  // InputError: it is missing
  double number() const;                        // finite
  int integer() const;
  std::string text() const;
  std::vector<JsonField> elements() const;  // of an array
  std::vector<double> numbers() const;      // of an array, finite
  std::vector<double> numbers(std::size_t count) const;
  [[noreturn]] void fail(const std::string& found, const std::string& expected) const;
};

struct NumberedField {
  int number;
  JsonField field;
};

// The fields of an object whose keys are numbers, as "000012". InputError naming the field: a key
// is no whole number, or two are the same one.
std::vector<NumberedField> numbered_fields(const JsonField& parent);

inline constexpr double METRES_PER_MM = 1e-3;  // BOP files have mm

// R: 9 numbers by row, or 3 rows. t: 3 numbers in units of `metres_per_unit`. Counts rotations that
// had to be projected (rotations.h). InputError: R is no rotation.
Se3 pose_from(const JsonField& rotation, const JsonField& translation, double metres_per_unit,
              ProjectedRotations& projected);
// Of a file of this program: as above, but R must be a rotation to rounding.
Se3 pose_from(const JsonField& rotation, const JsonField& translation, double metres_per_unit);
std::vector<double> rotation_numbers(const Se3& pose);  // by row
std::vector<double> translation_numbers(const Se3& pose, double metres_per_unit);
// Of a file of this program: R, 9 numbers by row, and t in metres.
nlohmann::ordered_json pose_json(const Se3& pose);

}  // namespace edgescout
