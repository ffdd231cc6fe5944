#include "host/io/json_fields.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <set>

#include "host/io/files.h"
#include "host/io/one_line.h"
#include "kernels/error.h"

namespace edgescout {

using nlohmann::json;

namespace {

// Keeps the keys of the objects that are open, since the JSON library keeps the last of two equal
// fields without a word.
class DuplicateCheck {
 public:
  explicit DuplicateCheck(const std::string& source) : source_(source) {}
  bool operator()(int, json::parse_event_t event, json& value) {
    if (event == json::parse_event_t::object_start) open_.emplace_back();
    if (event == json::parse_event_t::object_end) open_.pop_back();
    if (event != json::parse_event_t::key) return true;
    const auto& key = value.get_ref<const std::string&>();
    if (!open_.back().insert(key).second)
      throw InputError(source_, one_line(key), "the field twice", "it once");
    return true;
  }

 private:
  std::string source_;
  std::vector<std::set<std::string>> open_;
};

}  // namespace

json parse_json(const std::string& text, const std::string& source, bool allow_comments) {
  try {
    return json::parse(text, DuplicateCheck(source), true, allow_comments);
  } catch (const json::exception& error) {
    throw InputError(source, "JSON", error.what(), "a JSON file");
  }
}

json read_json(const std::filesystem::path& file) {
  json content = parse_json(read_file(file), file.string());
  if (!content.is_structured())
    throw InputError(file.string(), "JSON", content.type_name(), "an object or an array");
  return content;
}

void JsonField::fail(const std::string& found, const std::string& expected) const {
  throw InputError(source, path.empty() ? "/" : one_line(path), one_line(found), expected);
}

JsonField JsonField::at(const std::string& name) const {
  if (!value.is_object()) fail(value.type_name(), "an object");
  if (!value.contains(name)) JsonField{value, source, path + "/" + name}.fail("nothing", "a value");
  return {value.at(name), source, path + "/" + name};
}

double JsonField::number() const {
  if (!value.is_number()) fail(value.dump().substr(0, 40), "a number");
  const double x = value.get<double>();
  if (!std::isfinite(x)) fail("a number that is not finite", "a finite number");
  return x;
}

int JsonField::integer() const {
  const double x = number();
  if (x != std::floor(x) || std::abs(x) > 2e9) fail(value.dump(), "a whole number");
  return static_cast<int>(x);
}

std::string JsonField::text() const {
  if (!value.is_string()) fail(value.dump().substr(0, 40), "a text");
  return value.get<std::string>();
}

std::vector<JsonField> JsonField::elements() const {
  if (!value.is_array()) fail(value.type_name(), "an array");
  std::vector<JsonField> members;
  for (const json& element : value)
    members.push_back({element, source, path + "/" + std::to_string(members.size())});
  return members;
}

std::vector<double> JsonField::numbers() const {
  std::vector<double> result;
  for (const JsonField& element : elements()) result.push_back(element.number());
  return result;
}

std::vector<double> JsonField::numbers(std::size_t count) const {
  std::vector<double> result = numbers();
  if (result.size() != count)
    fail(std::to_string(result.size()) + " numbers", std::to_string(count));
  return result;
}

std::vector<NumberedField> numbered_fields(const JsonField& parent) {
  std::vector<NumberedField> fields;
  std::set<int> numbers;
  for (const auto& [key, value] : parent.value.items()) {
    int number = 0;
    const auto [end, error] = std::from_chars(key.data(), key.data() + key.size(), number);
    if (error != std::errc{} || end != key.data() + key.size())
      parent.fail("the key \"" + key + "\"", "a whole number");
    const JsonField field = parent.at(key);
    if (!numbers.insert(number).second) field.fail("the same number as another key", "it once");
    fields.push_back({number, field});
  }
  return fields;
}

namespace {

// 9 numbers by row, or 3 rows of 3.
std::vector<double> matrix_in(const JsonField& field) {
  const bool has_rows = field.value.is_array() && field.value.size() == 3 &&
                        std::ranges::all_of(field.value, &nlohmann::json::is_array);
  if (!has_rows) return field.numbers(9);
  std::vector<double> numbers;
  for (const JsonField& row : field.elements())
    for (const double number : row.numbers(3)) numbers.push_back(number);
  return numbers;
}

}  // namespace

Se3 pose_from(const JsonField& rotation, const JsonField& translation, double metres_per_unit,
              ProjectedRotations& projected) {
  const std::vector<double> r = matrix_in(rotation), t = translation.numbers(3);
  const Eigen::Matrix3d matrix =
      Eigen::Map<const Eigen::Matrix<double, 3, 3, Eigen::RowMajor>>(r.data());
  const std::optional<Se3> pose =
      nearest_rigid(matrix, metres_per_unit * Eigen::Vector3d(t[0], t[1], t[2]), projected);
  if (!pose) rotation.fail("a matrix that is no rotation", EXPECTED_ROTATION);
  return *pose;
}

Se3 pose_from(const JsonField& rotation, const JsonField& translation, double metres_per_unit) {
  ProjectedRotations projected;
  Se3 pose = pose_from(rotation, translation, metres_per_unit, projected);
  if (projected.count > 0)
    rotation.fail("a matrix that is no rotation", "one, to 0.0005 in every number");
  return pose;
}

std::vector<double> rotation_numbers(const Se3& pose) {
  const Eigen::Matrix<double, 3, 3, Eigen::RowMajor> matrix = pose.rotation.toRotationMatrix();
  return {matrix.data(), matrix.data() + 9};
}

std::vector<double> translation_numbers(const Se3& pose, double metres_per_unit) {
  const Eigen::Vector3d t = pose.translation_m / metres_per_unit;
  return {t.x(), t.y(), t.z()};
}

nlohmann::ordered_json pose_json(const Se3& pose) {
  return {{"R", rotation_numbers(pose)}, {"t", translation_numbers(pose, 1.0)}};
}

}  // namespace edgescout
