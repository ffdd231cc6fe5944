// Reads and writes the BOP results CSV.
#include <charconv>
#include <cmath>

#include "host/io/bop.h"
#include "host/io/files.h"
#include "host/io/text_tokens.h"
#include "kernels/error.h"

namespace edgescout {

namespace {

constexpr std::string_view header = "scene_id,im_id,obj_id,score,R,t,time";

std::vector<std::string> split(const std::string& text, char separator) {
  std::vector<std::string> parts(1);
  for (char c : text)
    if (c == separator)
      parts.emplace_back();
    else
      parts.back() += c;
  return parts;
}

struct CsvLine {
  std::string source;
  int number;

  std::vector<double> numbers(const std::string& text, const char* field, std::size_t count) const {
    TextTokens tokens(text, source + ": line " + std::to_string(number) + ", " + field);
    std::vector<double> values;
    while (!tokens.at_end()) values.push_back(tokens.number(field));
    for (double x : values)
      if (!std::isfinite(x)) fail(field, "a value that is not finite", "finite numbers");
    if (values.size() != count)
      fail(field, std::to_string(values.size()) + " numbers", std::to_string(count));
    return values;
  }
  int integer(const std::string& text, const char* field) const {
    const double value = numbers(text, field, 1)[0];
    if (value != std::floor(value) || std::abs(value) > 2e9) fail(field, text, "a whole number");
    return static_cast<int>(value);
  }
  [[noreturn]] void fail(const std::string& field, const std::string& found,
                         const std::string& expected) const {
    throw InputError(source, "line " + std::to_string(number) + ", " + field, found, expected);
  }
};

BopResult read_result(const std::string& text, const CsvLine& line) {
  const std::vector<std::string> fields = split(text, ',');
  if (fields.size() != 7)
    line.fail("fields", std::to_string(fields.size()), "7 (" + std::string(header) + ")");
  BopResult result;
  result.scene_id = line.integer(fields[0], "scene_id");
  result.image_id = line.integer(fields[1], "im_id");
  result.object_id = line.integer(fields[2], "obj_id");
  result.score = line.numbers(fields[3], "score", 1)[0];
  const std::vector<double> r = line.numbers(fields[4], "R", 9),
                            t = line.numbers(fields[5], "t", 3);
  const Eigen::Matrix3d rotation =
      Eigen::Map<const Eigen::Matrix<double, 3, 3, Eigen::RowMajor>>(r.data());
  try {
    result.camera_from_object = se3_from_matrix(rotation, 1e-3 * Eigen::Vector3d(t[0], t[1], t[2]));
  } catch (const InputError&) {
    line.fail("R", "a matrix that is no rotation", "R'R = I and det R = +1 to 1e-3");
  }
  result.time_s = line.numbers(fields[6], "time", 1)[0];
  return result;
}

// Returns the shortest text that reads back as the same number.
void append(std::string& text, double value, char after) {
  char digits[32];
  text.append(digits, std::to_chars(digits, digits + sizeof digits, value).ptr);
  text += after;
}

}  // namespace

std::vector<BopResult> load_bop_results(const std::filesystem::path& file) {
  std::vector<BopResult> results;
  CsvLine line{file.string(), 0};
  for (std::string text : split(read_file(file), '\n')) {
    ++line.number;
    if (!text.empty() && text.back() == '\r') text.pop_back();
    if (text.empty() || (line.number == 1 && text.starts_with("scene_id"))) continue;
    results.push_back(read_result(text, line));
  }
  return results;
}

void save_bop_results(const std::vector<BopResult>& results, const std::filesystem::path& file) {
  std::string text = std::string(header) + "\n";
  for (const BopResult& result : results) {
    for (int id : {result.scene_id, result.image_id, result.object_id})
      text += std::to_string(id) + ",";
    append(text, result.score, ',');
    const Eigen::Matrix3d r = result.camera_from_object.rotation.toRotationMatrix();
    for (int i = 0; i < 9; ++i) append(text, r(i / 3, i % 3), i < 8 ? ' ' : ',');
    for (int i = 0; i < 3; ++i)
      append(text, 1000 * result.camera_from_object.translation_m[i], i < 2 ? ' ' : ',');
    append(text, result.time_s, '\n');
  }
  write_file_atomically(file, text);
}

}  // namespace edgescout
