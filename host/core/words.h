// Cuts a line of text into words.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace edgescout {

// Without the blanks and tabs at both ends.
std::string trimmed(std::string_view line);

// What stands between any of these characters; never an empty word.
std::vector<std::string> words_of(std::string_view line, std::string_view between = " \t");

}  // namespace edgescout
