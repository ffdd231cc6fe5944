// Reads and writes the BOP results CSV.
#include <algorithm>
#include <array>
#include <cctype>
#include <charconv>
#include <cmath>
#include <optional>

#include "host/core/log.h"
#include "host/io/bop.h"
#include "host/io/files.h"
#include "host/io/lower_case.h"
#include "host/io/rotations.h"
#include "host/io/text_tokens.h"
#include "kernels/error.h"

namespace edgescout {

namespace {

constexpr std::string_view column_names = "scene_id,im_id,obj_id,score,R,t,time";

// The cells of a row. A cell in quotes may hold the separator.
std::vector<std::string> split(const std::string& text, char separator) {
  std::vector<std::string> cells(1);
  bool is_quoted = false;
  for (const char c : text)
    if (c == '"')
      is_quoted = !is_quoted;
    else if (c == separator && !is_quoted)
      cells.emplace_back();
    else
      cells.back() += c;
  return cells;
}

bool is_blank(const std::string& text) {
  return text.find_first_not_of(" \t") == std::string::npos;
}

struct CsvLine {
  std::string source;
  int number;

  std::vector<double> numbers(const std::string& text, const char* field, std::size_t count) const {
    TextTokens tokens(text, source, number);
    std::vector<double> values;
    while (!tokens.at_end()) values.push_back(tokens.number(field));
    if (values.size() != count)
      fail(field, std::to_string(values.size()) + " numbers", std::to_string(count));
    return values;
  }
  std::vector<double> finite_numbers(const std::string& text, const char* field,
                                     std::size_t count) const {
    std::vector<double> values = numbers(text, field, count);
    for (double x : values)
      if (!std::isfinite(x)) fail(field, "a value that is not finite", "finite numbers");
    return values;
  }
  // numpy writes its arrays in brackets, with or without commas.
  std::vector<double> numbers_of_array(std::string text, const char* field,
                                       std::size_t count) const {
    constexpr std::string_view marks = "[](),;";
    std::ranges::replace_if(
        text, [&](char c) { return marks.find(c) != std::string_view::npos; }, ' ');
    return finite_numbers(text, field, count);
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

enum Column {
  SceneColumn,
  ImageColumn,
  ObjectColumn,
  ScoreColumn,
  RotationColumn,
  TranslationColumn,
  TimeColumn,
  CameraColumn,
  ColumnCount
};

// Where the columns stand in a row.
struct CsvLayout {
  char separator = ',';
  std::size_t cells = 7;
  std::array<std::optional<std::size_t>, ColumnCount> places{0, 1, 2, 3, 4, 5, 6, {}};
  std::string names = std::string(column_names);
};

std::optional<Column> column_named(std::string name) {
  std::erase_if(name, [](unsigned char c) { return std::isspace(c); });
  name = lower_case(name);
  constexpr std::pair<std::string_view, Column> names[] = {
      {"scene_id", SceneColumn}, {"im_id", ImageColumn},      {"image_id", ImageColumn},
      {"obj_id", ObjectColumn},  {"object_id", ObjectColumn}, {"score", ScoreColumn},
      {"r", RotationColumn},     {"t", TranslationColumn},    {"time", TimeColumn},
      {"camera", CameraColumn}};
  for (const auto& [known, column] : names)
    if (name == known) return column;
  return {};
}

char separator_of(const std::string& line) {
  for (const char separator : {',', ';', '\t'})
    if (line.find(separator) != std::string::npos) return separator;
  return ',';
}

// The columns that the first line names. Nothing: it is a row.
std::optional<CsvLayout> named_columns(const std::string& text, const CsvLine& line) {
  CsvLayout layout{separator_of(text), 0, {}, text};
  bool is_header = false;
  std::string unused;
  for (const std::string& cell : split(text, layout.separator)) {
    const std::optional<Column> column = column_named(cell);
    is_header = is_header || column;
    if (!column)
      unused += (unused.empty() ? "" : ", ") + cell;
    else if (layout.places[*column])
      line.fail(cell, "the column twice", "it once");
    else
      layout.places[*column] = layout.cells;
    ++layout.cells;
  }
  if (!is_header) return {};
  for (int column = SceneColumn; column < TimeColumn; ++column)
    if (!layout.places[column]) line.fail("columns", text, std::string(column_names));
  if (!is_blank(unused))
    log(LogLevel::Info, line.source + ": columns that are not used: " + unused);
  return layout;
}

BopResult read_result(const std::vector<std::string>& cells, const CsvLayout& layout,
                      const CsvLine& line, ProjectedRotations& projected) {
  const bool has_empty_end = cells.size() == layout.cells + 1 && is_blank(cells.back());
  if (cells.size() != layout.cells && !has_empty_end)
    line.fail("fields", std::to_string(cells.size()),
              std::to_string(layout.cells) + " (" + layout.names + ")");
  const auto cell = [&](Column column) { return cells[*layout.places[column]]; };
  BopResult result;
  result.scene_id = line.integer(cell(SceneColumn), "scene_id");
  result.image_id = line.integer(cell(ImageColumn), "im_id");
  result.object_id = line.integer(cell(ObjectColumn), "obj_id");
  result.score = line.finite_numbers(cell(ScoreColumn), "score", 1)[0];
  const std::vector<double> r = line.numbers_of_array(cell(RotationColumn), "R", 9),
                            t = line.numbers_of_array(cell(TranslationColumn), "t", 3);
  const Eigen::Matrix3d rotation =
      Eigen::Map<const Eigen::Matrix<double, 3, 3, Eigen::RowMajor>>(r.data());
  const std::optional<Se3> pose =
      nearest_rigid(rotation, 1e-3 * Eigen::Vector3d(t[0], t[1], t[2]), projected);
  if (!pose) line.fail("R", "a matrix that is no rotation", EXPECTED_ROTATION);
  result.camera_from_object = *pose;
  if (layout.places[TimeColumn] && !is_blank(cell(TimeColumn))) {
    const double time_s = line.numbers(cell(TimeColumn), "time", 1)[0];
    if (std::isfinite(time_s)) result.time_s = time_s;
  }
  if (layout.places[CameraColumn]) result.camera_name = cell(CameraColumn);
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
  std::vector<std::string> lines(1);
  for (std::size_t i = 0; i < text.size(); ++i)
    if (text[i] != '\n' && text[i] != '\r')
      lines.back() += text[i];
    else if (text[i] == '\n' || i + 1 == text.size() || text[i + 1] != '\n')
      lines.emplace_back();
  return lines;
}

// Returns the shortest text that reads back as the same number.
void append(std::string& text, double value, char after) {
  char digits[32];
  text.append(digits, std::to_chars(digits, digits + sizeof digits, value).ptr);
  text += after;
}

}  // namespace

std::vector<BopResult> load_bop_results(const std::filesystem::path& file) {
  return load_bop_result_rows(file).results;
}

BopResultRows load_bop_result_rows(const std::filesystem::path& file) {
  std::vector<BopResult> results;
  CsvLine line{file.string(), 0};
  PassedOver passed_over;
  ProjectedRotations projected;
  std::optional<CsvLayout> layout;
  for (const std::string& text : lines_of(file)) {
    ++line.number;
    if (is_blank(text) || text.starts_with('#')) continue;
    if (!layout) {
      layout = named_columns(text, line);
      if (layout) continue;
      layout.emplace();
      layout->separator = separator_of(text);
    }
    try {
      results.push_back(read_result(split(text, layout->separator), *layout, line, projected));
    } catch (const InputError& error) {
      if (passed_over.rows++ == 0) passed_over.first = error.what();
    }
  }
  if (!layout)
    throw InputError(file.string(), "file", "nothing", "the columns " + std::string(column_names));
  report(passed_over, results.size(), file.string());
  warn_of_projected(projected, file.string());
  return {std::move(results), passed_over.rows};
}

void save_bop_results(const std::vector<BopResult>& results, const std::filesystem::path& file) {
  const bool has_cameras = std::ranges::any_of(
      results, [](const BopResult& result) { return !result.camera_name.empty(); });
  std::string text = std::string(column_names) + (has_cameras ? ",camera\n" : "\n");
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
