// The parts that the program's HTML pages share.
#pragma once

#include <string>

namespace edgescout {

// The text with the characters that HTML reserves written as entities.
std::string escaped_html(const std::string& text);

// A number with its label, in a row of such tiles.
std::string tile(const std::string& value, const std::string& label);

// A whole page. It needs no network. `head` ends its <head>.
std::string html_page(const std::string& title, const std::string& head, const std::string& body);

}  // namespace edgescout
