// Internal to host/io: splits a text into words, with errors that name the file and the line.
#pragma once

#include <string>
#include <string_view>

namespace edgescout {

class TextTokens {
 public:
  // Keeps a reference to `text`, which begins in the line of that number.
  TextTokens(std::string_view text, std::string source, int line = 1)
      : text_(text), source_(std::move(source)), line_(line) {}

  bool at_end();                            // only white space is left
  bool at_line_end();                       // only white space is left in the line
  std::string_view word(const char* what);  // InputError at the end of the text: "truncated"
  void expect(std::string_view expected);
  // "nan" and "inf" are read as such, MSVC's "1.#QNAN" and the like as NaN. The exponent is written
  // with e, E, d or D.
  double number(const char* what);
  int count(const char* what);  // 0 .. 100 million
  void skip_line();             // lines end in LF, CR LF or CR
  [[noreturn]] void fail(const std::string& expected, std::string_view found) const;

 private:
  std::string_view text_;
  std::string source_;
  std::size_t at_ = 0;
  int line_;
};

}  // namespace edgescout
