// Internal to host/io: words and endings that count in any case.
#pragma once

#include <algorithm>
#include <cctype>
#include <string>

namespace edgescout {

inline std::string lower_case(std::string text) {
  std::ranges::transform(text, text.begin(),
                         [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return text;
}

}  // namespace edgescout
