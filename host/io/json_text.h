// Writes JSON to text, for files and standard output. Not installed.
//
// A path or a name may hold bytes that are no UTF-8. JSON cannot hold them. Each becomes U+FFFD, so
// that the result is not lost.
#pragma once

#include <algorithm>
#include <nlohmann/json.hpp>
#include <string>

namespace edgescout {

// The text ends with a line break.
template <typename Json>
std::string json_text(const Json& content, int indent = 1) {
  return content.dump(indent, ' ', false, Json::error_handler_t::replace) + "\n";
}

// Returns the text as it is read back from such a file. Use it to compare a name with one that was
// read.
inline std::string as_in_json(const std::string& text) {
  if (std::ranges::all_of(text, [](unsigned char byte) { return byte < 0x80; })) return text;
  return nlohmann::json::parse(json_text(nlohmann::json(text))).get<std::string>();
}

}  // namespace edgescout
