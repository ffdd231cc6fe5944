// Keeps errors to one line, whatever the file holds that they quote. Not installed.
#pragma once

#include <algorithm>
#include <string>

#include "kernels/error.h"

namespace edgescout {

// Line breaks and other control characters become blanks.
inline std::string one_line(std::string text) {
  std::ranges::replace_if(
      text, [](unsigned char byte) { return byte < 0x20 || byte == 0x7f; }, ' ');
  return text;
}

// Returns the result of `read`; its InputErrors become one line. Names of fields come from the
// file.
template <typename Read>
auto with_errors_of_one_line(Read read) {
  try {
    return read();
  } catch (const InputError& error) {
    throw InputError(one_line(error.what()));
  }
}

}  // namespace edgescout
