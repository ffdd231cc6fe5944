// Cameras as programs print them, for eyes rather than for readers.
#include <algorithm>
#include <cctype>

#include "host/core/words.h"
#include "host/io/camera_fields.h"
#include "host/io/camera_tree.h"
#include "kernels/error.h"

namespace edgescout {

using nlohmann::json;

namespace {

bool is_name(std::string_view word) {
  constexpr std::size_t longest = 60;
  return !word.empty() && word.size() < longest &&
         !std::isdigit(static_cast<unsigned char>(word[0])) &&
         std::ranges::all_of(word, [](unsigned char c) {
           return std::isalnum(c) || c == '_' || c == '.' || c == '%' || c == '-';
         });
}

std::vector<std::string> cells_of(const std::string& line, char separator) {
  std::vector<std::string> cells;
  for (std::size_t at = 0; at <= line.size();) {
    const std::size_t end = std::min(line.find(separator, at), line.size());
    std::string cell = trimmed(std::string_view(line).substr(at, end - at));
    if (cell.size() > 1 && cell.front() == '"' && cell.back() == '"')
      cell = cell.substr(1, cell.size() - 2);
    cells.push_back(std::move(cell));
    at = end + 1;
  }
  return cells;
}

// Programs of countries with a decimal comma separate by semicolons.
char column_separator(const std::string& line) {
  for (const char separator : {';', ','})
    if (line.find(separator) != std::string::npos) return separator;
  return '\t';
}

// rostopic writes field.K0 .. field.K8: they are one list.
void add_cell(json& camera, std::string name, const std::string& cell, const std::string& source) {
  constexpr std::string_view of_rostopic = "field.";
  if (!name.starts_with(of_rostopic)) return add_field(camera, name, scalar_of(cell), source);
  name.erase(0, of_rostopic.size());
  const std::size_t end = name.find_last_not_of("0123456789") + 1;
  if (end == name.size()) return add_field(camera, name, scalar_of(cell), source);
  add_to_list(camera, name.substr(0, end), scalar_of(cell), source);
}

// Names in the first line, a camera in every other one.
json table_of_cameras(const std::vector<std::string>& lines, const std::string& source) {
  const char separator = column_separator(lines.front());
  const std::vector<std::string> names = cells_of(lines.front(), separator);
  if (lines.size() < 2 || names.size() < 4 || !std::ranges::all_of(names, is_name)) return nullptr;
  constexpr std::size_t most_cells = 100'000;
  if (lines.size() * names.size() > most_cells)
    throw InputError(source, "table", std::to_string(lines.size()) + " lines", "a few");
  json cameras = json::array();
  for (std::size_t i = 1; i < lines.size(); ++i) {
    const std::vector<std::string> cells = cells_of(lines[i], separator);
    if (cells.size() != names.size()) return nullptr;
    cameras.push_back(json::object());
    for (std::size_t k = 0; k < names.size(); ++k)
      add_cell(cameras.back(), names[k], cells[k], source);
  }
  return cameras;
}

// "fx 700", "fx,700", "K 700 0 321 0 700 238 0 0 1". In a line with both semicolons and commas the
// commas may be decimal ones.
json names_before_numbers(const std::vector<std::string>& lines, const std::string& source) {
  json camera = json::object();
  for (const std::string& line : lines) {
    if (line.find(';') != std::string::npos && line.find(',') != std::string::npos) return nullptr;
    const std::size_t end = line.find_first_of(" \t,;");
    if (end == std::string::npos || !is_name(line.substr(0, end))) return nullptr;
    const json numbers = numbers_in(line.substr(end));
    if (numbers.is_null()) return nullptr;
    add_field(camera, line.substr(0, end), numbers.size() == 1 ? numbers[0] : numbers, source);
  }
  return camera;
}

// The text between two marks. Empty: they are not there.
std::string between(const std::string& text, std::string_view before, char after) {
  const std::size_t start = text.find(before);
  if (start == std::string::npos) return "";
  const std::size_t from = start + before.size(), end = text.find(after, from);
  return end == std::string::npos ? "" : text.substr(from, end - from);
}

// "[ 640x480  p[321 238]  f[700 701]  Brown Conrady [0 0 0 0 0] ]" of pyrealsense2, also behind a
// title with a colon.
json realsense_print(const std::vector<std::string>& lines) {
  const std::string& line = lines.front();
  const std::size_t focal_at = line.find(" f["), open = line.find('[');
  if (lines.size() != 1 || focal_at == std::string::npos || open == std::string::npos ||
      (open > 0 && !trimmed(line.substr(0, open)).ends_with(':')))
    return nullptr;
  const json center = numbers_in(between(line, " p[", ']')),
             focal = numbers_in(between(line, " f[", ']'));
  const std::size_t model_at = line.find(']', focal_at) + 1, list_at = line.find('[', model_at);
  if (center.size() != 2 || focal.size() != 2 || list_at == std::string::npos) return nullptr;
  return {{"resolution", trimmed(between(line, "[", 'p'))},
          {"ppx", center[0]},
          {"ppy", center[1]},
          {"fx", focal[0]},
          {"fy", focal[1]},
          {"model", trimmed(line.substr(model_at, list_at - model_at))},
          {"coeffs", numbers_in(line.substr(list_at))}};
}

// "fx=700 fy=701, cx=321 cy=238" in one line.
json assignments_in_a_line(const std::vector<std::string>& lines, const std::string& source) {
  const std::vector<std::string> words = words_of(lines.front(), " \t,;");
  if (lines.size() != 1 || words.size() < 2) return nullptr;
  json camera = json::object();
  for (const std::string& word : words) {
    const std::size_t equals = word.find('=');
    if (equals == std::string::npos || !is_name(word.substr(0, equals))) return nullptr;
    add_field(camera, word.substr(0, equals), scalar_of(word.substr(equals + 1)), source);
  }
  return camera;
}

// A line of `ros2 topic echo --csv`, which has no names: stamp (2), frame_id, height, width, model,
// d, k (9), r (9), p (12), binning (2), roi (5). What is left over is d. Null: of another form.
json ros2_row(const std::string& line) {
  constexpr std::size_t before = 6, behind = 9 + 9 + 12 + 2 + 5;
  const std::vector<std::string> cells = cells_of(line, ',');
  if (cells.size() < before + behind || !is_name(cells[5])) return nullptr;
  std::vector<json> values;
  for (const std::string& cell : cells) values.push_back(scalar_of(cell));
  for (std::size_t i = 0; i + 1 < values.size(); ++i)
    if (i != 2 && i != 5 && !values[i].is_number()) return nullptr;
  if (!values.back().is_boolean()) return nullptr;  // do_rectify
  const auto k = values.end() - behind, roi = values.end() - 5;
  return {
      {"height", values[3]},
      {"width", values[4]},
      {"distortion_model", cells[5]},
      {"d", json(std::vector<json>(values.begin() + before, k))},
      {"k", json(std::vector<json>(k, k + 9))},
      {"binning_x", roi[-2]},
      {"binning_y", roi[-1]},
      {"roi", {{"x_offset", roi[0]}, {"y_offset", roi[1]}, {"height", roi[2]}, {"width", roi[3]}}}};
}

json ros2_rows(const std::vector<std::string>& lines) {
  json cameras = json::array();
  for (const std::string& line : lines) {
    json camera = ros2_row(line);
    if (camera.is_null()) return nullptr;
    cameras.push_back(std::move(camera));
  }
  return cameras;
}

// The name before a bracket: "sensor_msgs.msg.CameraInfo(" without it. Empty: there is none.
std::string_view message_name_at(std::string_view text, std::size_t at) {
  constexpr std::size_t longest = 60;
  const std::string_view ahead = text.substr(at, longest);
  const std::string_view name = ahead.substr(0, ahead.find('('));
  return name.size() < ahead.size() && is_name(name) ? name : std::string_view();
}

// "a.Name(x=1, y=b.Other(z=[2]))" -> "{x: 1, y: {z: [2]}}". Within array(..) stand a list and,
// before or after it, its type.
std::string message_as_yaml(std::string_view text) {
  std::string yaml;
  for (std::size_t at = 0; at < text.size(); ++at) {
    const bool begins_name = std::isalpha(static_cast<unsigned char>(text[at])) != 0;
    const std::string_view name = begins_name ? message_name_at(text, at) : std::string_view();
    if (name == "array") {
      const std::size_t open = text.find('[', at), close = text.find(']', open);
      if (close == std::string_view::npos) return std::string(text);
      yaml += text.substr(open, close + 1 - open);
      at = std::min(text.find(')', close), text.size());
    } else if (!name.empty()) {
      yaml += '{';
      at += name.size();
    } else if (begins_name) {
      const std::size_t end = std::min(text.find_first_of("=,()[]' \n", at), text.size());
      yaml += text.substr(at, end - at);
      at = end - 1;
    } else {
      yaml +=
          text[at] == '=' ? std::string(": ") : std::string(1, text[at] == ')' ? '}' : text[at]);
    }
  }
  return yaml;
}

}  // namespace

json printed_camera_tree(const std::vector<std::string>& lines, const std::string& source) {
  if (json tree = realsense_print(lines); !tree.is_null()) return tree;
  if (json tree = assignments_in_a_line(lines, source); !tree.is_null()) return tree;
  if (json tree = ros2_rows(lines); !tree.is_null()) return tree;
  if (json tree = table_of_cameras(lines, source); !tree.is_null()) return tree;
  return names_before_numbers(lines, source);
}

std::string without_ros_prints(const std::string& text) {
  if (const std::size_t start = text.find_first_not_of(" \t\n");
      start != std::string::npos && message_name_at(text, start).ends_with("CameraInfo"))
    return message_as_yaml(text);
  constexpr std::string_view lost = "A message was lost!!!", last = "total count: ";
  constexpr std::size_t most_between = 60;
  std::string kept;
  std::size_t at = 0;
  for (std::size_t found; (found = text.find(lost, at)) != std::string::npos;) {
    kept.append(text, at, found - at);
    at = found + lost.size();
    const std::string_view ahead = std::string_view(text).substr(at, most_between);
    if (const std::size_t count = ahead.find(last); count != std::string_view::npos)
      at = std::min(text.find_first_not_of("0123456789", at + count + last.size()), text.size());
    kept += '\n';
  }
  return kept.append(text, at);
}

std::string printed_as_yaml(const std::string& text) {
  const std::size_t start = text.find_first_not_of(" \t\n");
  if (start == std::string::npos) return text;
  if (text[start] == '{') {
    std::string lists;
    for (std::size_t at = start; at < text.size(); ++at) {
      constexpr std::string_view array = "array(";
      if (text.compare(at, array.size(), array) == 0) at += array.size() - 1;
      lists += text[at] == '(' ? '[' : text[at] == ')' ? ']' : text[at];
    }
    return lists;
  }
  const std::string line = trimmed(text.substr(start, text.find_last_not_of(" \t\n") + 1 - start));
  const bool is_one_line = line.find('\n') == std::string::npos;
  const std::size_t comma = line.find(", "), colon = line.find(": ");
  if (is_one_line && colon < comma && comma != std::string::npos &&
      line.find(": ", comma) != std::string::npos && is_name(line.substr(0, colon)))
    return "{" + line + "}";
  return text;
}

json headed_numbers(const std::string& text) {
  json camera = json::object();
  std::string name;
  bool has_matrix = false;
  for (const std::string& written : words_of(text, "\n")) {
    const std::string line = trimmed(written);
    const json numbers = numbers_in(line);
    if (line.empty()) continue;
    if (numbers.is_null()) {
      const std::size_t end = line.find_first_of(":=");
      name = trimmed(line.substr(0, end));
      const std::string value = end == std::string::npos ? "" : trimmed(line.substr(end + 1));
      if (camera.contains(name)) return nullptr;
      camera[name] = value.empty() ? json::array() : value_in(value);
    } else if (name.empty() || !camera[name].is_array()) {
      return nullptr;
    } else {
      for (const json& number : numbers) camera[name].push_back(number);
      has_matrix = has_matrix || is_matrix_name(plain_name(name));
    }
  }
  return has_matrix ? camera : json(nullptr);
}

}  // namespace edgescout
