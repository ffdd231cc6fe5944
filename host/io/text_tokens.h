// Internal to host/io: splits a text into words, with errors that name the file and the line.
#pragma once

#include <string>
#include <string_view>

namespace edgescout {

class TextTokens {
 public:
  // Keeps a reference to `text`.
  TextTokens(std::string_view text, std::string source) : text_(text), source_(std::move(source)) {}

  bool at_end();                            // only white space is left
  std::string_view word(const char* what);  // InputError at the end of the text: "truncated"
  void expect(std::string_view expected);
  double number(const char* what);  // "nan" and "inf" are read as such
  int count(const char* what);      // 0 .. 100 million
  void skip_line();
  [[noreturn]] void fail(const std::string& expected, std::string_view found) const;

 private:
  std::string_view text_;
  std::string source_;
  std::size_t at_ = 0;
  int line_ = 1;
};

}  // namespace edgescout
