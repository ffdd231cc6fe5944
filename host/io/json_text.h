// JSON as it is written to files and standard output. Not installed.
//
// A path or a name may hold bytes that are no UTF-8, which JSON cannot: they become U+FFFD, one and
// the same for all of them, rather than lose the result.
#pragma once

#include <algorithm>
#include <nlohmann/json.hpp>
#include <string>

namespace edgescout {

// With a line break at the end.
template <typename Json>
std::string json_text(const Json& json, int indent = 1) {
  return json.dump(indent, ' ', false, Json::error_handler_t::replace) + "\n";
}

// A text as it comes back from such a file: to be compared with what was read there.
inline std::string as_in_json(const std::string& text) {
  if (std::ranges::all_of(text, [](unsigned char byte) { return byte < 0x80; })) return text;
  return nlohmann::json::parse(json_text(nlohmann::json(text))).get<std::string>();
}

}  // namespace edgescout
