#include "host/core/words.h"

#include <algorithm>

namespace edgescout {

std::string trimmed(std::string_view line) {
  const std::size_t from = line.find_first_not_of(" \t");
  if (from == std::string_view::npos) return "";
  return std::string(line.substr(from, line.find_last_not_of(" \t") + 1 - from));
}

std::vector<std::string> words_of(std::string_view line, std::string_view between) {
  std::vector<std::string> words;
  for (std::size_t at = line.find_first_not_of(between); at != std::string_view::npos;) {
    const std::size_t end = std::min(line.find_first_of(between, at), line.size());
    words.emplace_back(line.substr(at, end - at));
    at = line.find_first_not_of(between, end);
  }
  return words;
}

}  // namespace edgescout
