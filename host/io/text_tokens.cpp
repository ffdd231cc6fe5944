#include "host/io/text_tokens.h"

#include <charconv>

#include "kernels/error.h"

namespace edgescout {

namespace {
constexpr std::string_view white_space = " \t\r\n\f\v";
constexpr int max_count = 100'000'000;
}  // namespace

bool TextTokens::at_end() {
  for (; at_ < text_.size() && white_space.find(text_[at_]) != std::string_view::npos; ++at_)
    if (text_[at_] == '\n') ++line_;
  return at_ == text_.size();
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
  double value = 0;
  const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), value);
  if (error != std::errc{} || end != digits.data() + digits.size())
    fail(std::string(what) + " (a number)", found);
  return value;
}

int TextTokens::count(const char* what) {
  const std::string_view found = word(what);
  int value = -1;
  const auto [end, error] = std::from_chars(found.data(), found.data() + found.size(), value);
  if (error != std::errc{} || end != found.data() + found.size() || value < 0 || value > max_count)
    fail(std::string(what) + " (a whole number of at least 0)", found);
  return value;
}

void TextTokens::skip_line() { at_ = std::min(text_.find('\n', at_), text_.size()); }

void TextTokens::fail(const std::string& expected, std::string_view found) const {
  throw InputError(source_, "line " + std::to_string(line_), std::string(found.substr(0, 60)),
                   expected);
}

}  // namespace edgescout
