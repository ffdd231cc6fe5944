#include "host/io/camera_tree.h"

#include <algorithm>
#include <cctype>
#include <charconv>
#include <cmath>
#include <limits>
#include <optional>

#include "host/core/words.h"
#include "host/io/json_fields.h"
#include "kernels/error.h"

namespace edgescout {

using nlohmann::json;

namespace {

// Windows shells write the output of programs as UTF-16. Calibrations are ASCII: other characters,
// as in a name, become "?".
std::string from_utf16(std::string_view bytes) {
  std::string text;
  const bool little = bytes[0] == '\xff';
  for (std::size_t i = 2; i + 1 < bytes.size(); i += 2) {
    const char low = bytes[little ? i : i + 1], high = bytes[little ? i + 1 : i];
    text += high == 0 ? low : '?';
  }
  return text;
}

std::string plain_text(const std::string& bytes, const std::string& source) {
  std::string text = bytes;
  if (bytes.starts_with("\xff\xfe") || bytes.starts_with("\xfe\xff")) text = from_utf16(bytes);
  if (text.starts_with("\xef\xbb\xbf")) text.erase(0, 3);
  if (text.find('\0') != std::string::npos)
    throw InputError(source, "file", "binary data",
                     "a camera calibration as text (YAML, JSON, XML, cameras.txt ..)");
  std::erase(text, '\r');
  return text;
}

std::optional<double> number_in(std::string_view word) {
  if (word.starts_with('+')) word.remove_prefix(1);
  double number = 0;
  const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), number);
  if (end != word.data() + word.size() || word.empty()) return {};
  if (error == std::errc::result_out_of_range) return std::numeric_limits<double>::infinity();
  return error == std::errc{} ? std::optional(number) : std::nullopt;
}

std::string lower(std::string word) {
  std::ranges::transform(word, word.begin(), [](unsigned char c) { return char(std::tolower(c)); });
  return word;
}

}  // namespace

json scalar_of(const std::string& word) {
  if (const std::optional<double> number = number_in(word)) return *number;
  const std::string small = lower(word);
  if (small.empty() || small == "~" || small == "null") return nullptr;
  if (small == "true" || small == "false") return small == "true";
  constexpr double infinity = std::numeric_limits<double>::infinity();
  if (small == ".nan") return std::numeric_limits<double>::quiet_NaN();
  if (small == ".inf" || small == "+.inf") return infinity;
  if (small == "-.inf") return -infinity;
  return word;
}

json numbers_in(std::string_view text) {
  constexpr std::string_view between = " \t\n,;[](){}";
  json numbers = json::array();
  for (std::size_t at = text.find_first_not_of(between); at != std::string_view::npos;) {
    const std::size_t end = std::min(text.find_first_of(between, at), text.size());
    const json number = scalar_of(std::string(text.substr(at, end - at)));
    if (!number.is_number()) return nullptr;
    numbers.push_back(number);
    at = text.find_first_not_of(between, end);
  }
  if (numbers.empty()) return nullptr;
  return numbers;
}

json value_in(const std::string& text) {
  const json numbers = numbers_in(text);
  if (numbers.is_null()) return scalar_of(text);
  return numbers.size() == 1 ? numbers[0] : numbers;
}

std::vector<std::string> with_whole_lists(const std::vector<std::string>& lines, char assigns) {
  std::vector<std::string> whole;
  int open_brackets = 0;
  for (const std::string& line : lines) {
    const bool goes_on = open_brackets > 0 && whole.back().find(assigns) != std::string::npos;
    if (!goes_on) open_brackets = 0;
    std::string text;
    for (const char c : line) {
      if (c == '#' || (c == ';' && open_brackets <= 0)) break;
      open_brackets += c == '[' ? 1 : c == ']' ? -1 : 0;
      text += c;
    }
    if (goes_on)
      whole.back().append(1, ' ').append(trimmed(text));
    else
      whole.push_back(trimmed(text));
  }
  return whole;
}

void add_field(json& object, const std::string& name, json value, const std::string& source) {
  if (object.contains(name)) throw InputError(source, name, "the field twice", "it once");
  object[name] = std::move(value);
}

void add_to_list(json& object, const std::string& name, json value, const std::string& source) {
  json& list = object[name];
  if (!list.is_null() && !list.is_array())
    throw InputError(source, name, "a value alone and numbers of a list", "one of them");
  list.push_back(std::move(value));
}

json parse_camera_tree(const std::string& bytes, const std::string& source, bool is_json) {
  const std::string text = without_ros_prints(plain_text(bytes, source));
  const std::size_t start = text.find_first_not_of(" \t\n");
  if (start == std::string::npos)
    throw InputError(source, "file", "nothing", "a camera calibration");
  if (is_json) return parse_json(text, source, true);
  if (text[start] == '<') return xml_camera_tree(text, source);
  // A YAML map may begin with a brace as well.
  if (text[start] == '{' && json::accept(text, true)) return parse_json(text, source, true);
  if (json tree = text_camera_tree(text, source); !tree.is_null()) return tree;
  try {
    json tree = yaml_camera_tree(printed_as_yaml(text), source);
    if (tree.is_structured()) return tree;
  } catch (const InputError&) {
    if (json tree = headed_numbers(text); !tree.is_null()) return tree;
    throw;
  }
  return headed_numbers(text);  // to YAML a single text of several lines
}

}  // namespace edgescout
