#include "host/io/text_tokens.h"

#include <algorithm>
#include <charconv>
#include <cstdlib>
#include <limits>
#include <optional>

#include "kernels/error.h"

namespace edgescout {

namespace {
constexpr std::string_view white_space = " \t\r\n\f\v", line_ends = "\r\n";
constexpr int max_count = 100'000'000;

bool is_in(char c, std::string_view set) { return set.find(c) != std::string_view::npos; }

std::optional<double> plain_number(std::string_view digits) {
  double value = 0;
  const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), value);
  if (end != digits.data() + digits.size()) return {};
  if (error == std::errc{}) return value;
  if (error != std::errc::result_out_of_range) return {};
  return std::strtod(std::string(digits).c_str(), nullptr);  // 0 or infinity
}

// What std::from_chars does not read: Fortran's exponents, MSVC's words for NaN and infinity.
std::optional<double> rare_number(std::string_view digits) {
  std::string text(digits);
  if (text.find(".#") != std::string::npos &&
      is_in(text.back(), "0123456789DFN"))  // -1.#IND, 1.#QNAN0, 1.#INF
    return std::numeric_limits<double>::quiet_NaN();
  std::ranges::replace(text, 'd', 'e');
  std::ranges::replace(text, 'D', 'e');
  return plain_number(text);
}
}  // namespace

bool TextTokens::at_end() {
  for (; at_ < text_.size() && is_in(text_[at_], white_space); ++at_)
    if (text_[at_] == '\n' ||
        (text_[at_] == '\r' && (at_ + 1 == text_.size() || text_[at_ + 1] != '\n')))
      ++line_;
  return at_ == text_.size();
}

bool TextTokens::at_line_end() {
  while (at_ < text_.size() && is_in(text_[at_], " \t\f\v")) ++at_;
  return at_ == text_.size() || is_in(text_[at_], line_ends);
}

std::string_view TextTokens::word(const char* what) {
  if (at_end()) fail(what, "the end of the file (truncated?)");
  const std::size_t end = std::min(text_.find_first_of(white_space, at_), text_.size());
  const std::string_view found = text_.substr(at_, end - at_);
  at_ = end;
  return found;
}

void TextTokens::expect(std::string_view expected) {
  const std::string name(expected);
  if (const std::string_view found = word(name.c_str()); found != expected) fail(name, found);
}

double TextTokens::number(const char* what) {
  const std::string_view found = word(what);
  const std::string_view digits = found.starts_with('+') ? found.substr(1) : found;
  if (const std::optional<double> value = plain_number(digits)) return *value;
  if (const std::optional<double> value = rare_number(digits)) return *value;
  const bool has_comma = found.find(',') != std::string_view::npos;
  fail(std::string(what) + (has_comma ? " (a number with a decimal point)" : " (a number)"), found);
}

int TextTokens::count(const char* what) {
  const std::string_view found = word(what);
  int value = -1;
  const auto [end, error] = std::from_chars(found.data(), found.data() + found.size(), value);
  if (error != std::errc{} || end != found.data() + found.size() || value < 0 || value > max_count)
    fail(std::string(what) + " (a whole number of at least 0)", found);
  return value;
}

void TextTokens::skip_line() { at_ = std::min(text_.find_first_of(line_ends, at_), text_.size()); }

void TextTokens::fail(const std::string& expected, std::string_view found) const {
  throw InputError(source_, "line " + std::to_string(line_), std::string(found.substr(0, 60)),
                   expected);
}

}  // namespace edgescout
