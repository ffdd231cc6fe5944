// Reads and writes the BOP results CSV.
#include <algorithm>
#include <charconv>
#include <cmath>

#include "host/core/log.h"
#include "host/io/bop.h"
#include "host/io/files.h"
#include "host/io/rotations.h"
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
    if (values.size() != count)
      fail(field, std::to_string(values.size()) + " numbers", std::to_string(count));
    return values;
  }
  std::vector<double> finite_numbers(const std::string& text, const char* field,
                                     std::size_t count) const {
    const std::vector<double> values = numbers(text, field, count);
    for (double x : values)
      if (!std::isfinite(x)) fail(field, "a value that is not finite", "finite numbers");
    return values;
  }
  int integer(const std::string& text, const char* field) const {
    const double value = finite_numbers(text, field, 1)[0];
    if (value != std::floor(value) || std::abs(value) > 2e9) fail(field, text, "a whole number");
    return static_cast<int>(value);
  }
  [[noreturn]] void fail(const std::string& field, const std::string& found,
                         const std::string& expected) const {
    throw InputError(source, "line " + std::to_string(number) + ", " + field, found, expected);
  }
};

BopResult read_result(const std::vector<std::string>& fields, bool has_cameras, const CsvLine& line,
                      ProjectedRotations& projected) {
  const std::size_t columns = has_cameras ? 8 : 7;
  if (fields.size() != columns)
    line.fail(
        "fields", std::to_string(fields.size()),
        std::to_string(columns) + " (" + std::string(header) + (has_cameras ? ",camera)" : ")"));
  BopResult result;
  result.scene_id = line.integer(fields[0], "scene_id");
  result.image_id = line.integer(fields[1], "im_id");
  result.object_id = line.integer(fields[2], "obj_id");
  result.score = line.finite_numbers(fields[3], "score", 1)[0];
  const std::vector<double> r = line.finite_numbers(fields[4], "R", 9),
                            t = line.finite_numbers(fields[5], "t", 3);
  const Eigen::Matrix3d rotation =
      Eigen::Map<const Eigen::Matrix<double, 3, 3, Eigen::RowMajor>>(r.data());
  const std::optional<Se3> pose =
      nearest_rigid(rotation, 1e-3 * Eigen::Vector3d(t[0], t[1], t[2]), projected);
  if (!pose) line.fail("R", "a matrix that is no rotation", EXPECTED_ROTATION);
  result.camera_from_object = *pose;
  const double time_s = line.numbers(fields[6], "time", 1)[0];
  result.time_s = std::isfinite(time_s) ? time_s : -1;
  if (has_cameras) result.camera_name = fields[7];
  return result;
}

// The rows that hold no pose.
struct PassedOver {
  int rows = 0;
  std::string first;  // what the first lacks
};

void report(const PassedOver& passed_over, std::size_t read, const std::string& file) {
  if (passed_over.rows == 0) return;
  if (read == 0) throw InputError(passed_over.first);
  log(LogLevel::Warning, file + ": " + std::to_string(passed_over.rows) + " of " +
                             std::to_string(passed_over.rows + int(read)) +
                             " rows hold no pose and are left out; the first: " +
                             passed_over.first.substr(file.size() + 2));  // without "FILE: "
}

std::vector<std::string> lines_of(const std::filesystem::path& file) {
  std::string text = read_file(file);
  if (text.starts_with("\xff\xfe") || text.starts_with("\xfe\xff"))
    throw InputError(file.string(), "text", "UTF-16", "UTF-8");
  if (text.starts_with("\xef\xbb\xbf")) text.erase(0, 3);
  std::erase(text, '\r');
  return split(text, '\n');
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
  PassedOver passed_over;
  ProjectedRotations projected;
  bool has_cameras = false;
  for (const std::string& text : lines_of(file)) {
    ++line.number;
    if (text.find_first_not_of(" \t") == std::string::npos) continue;
    const std::vector<std::string> fields = split(text, ',');
    if (line.number == 1 && text.starts_with("scene_id")) {
      has_cameras = fields.size() == 8 && fields[7] == "camera";
      continue;
    }
    try {
      results.push_back(read_result(fields, has_cameras, line, projected));
    } catch (const InputError& error) {
      if (passed_over.rows++ == 0) passed_over.first = error.what();
    }
  }
  report(passed_over, results.size(), file.string());
  warn_of_projected(projected, file.string());
  return results;
}

void save_bop_results(const std::vector<BopResult>& results, const std::filesystem::path& file) {
  const bool has_cameras = std::ranges::any_of(
      results, [](const BopResult& result) { return !result.camera_name.empty(); });
  std::string text = std::string(header) + (has_cameras ? ",camera\n" : "\n");
  for (const BopResult& result : results) {
    for (int id : {result.scene_id, result.image_id, result.object_id})
      text += std::to_string(id) + ",";
    append(text, result.score, ',');
    const Eigen::Matrix3d r = result.camera_from_object.rotation.toRotationMatrix();
    for (int i = 0; i < 9; ++i) append(text, r(i / 3, i % 3), i < 8 ? ' ' : ',');
    for (int i = 0; i < 3; ++i)
      append(text, 1000 * result.camera_from_object.translation_m[i], i < 2 ? ' ' : ',');
    append(text, result.time_s, has_cameras ? ',' : '\n');
    if (has_cameras) text += result.camera_name + "\n";
  }
  write_file_atomically(file, text);
}

}  // namespace edgescout
