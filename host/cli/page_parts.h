// The parts that the program's HTML pages share.
#pragma once

#include <string>
#include <string_view>

namespace edgescout {

// The text with the characters that HTML reserves written as entities.
std::string escaped_html(const std::string& text);

// A number with its label, in a row of such tiles.
std::string tile(const std::string& value, const std::string& label);

// For data: addresses (RFC 4648).
std::string base64(std::string_view bytes);

// A whole page. It needs no network. `head` ends its <head>.
std::string html_page(const std::string& title, const std::string& head, const std::string& body);
// The same of a body that is written part by part: what stands before and after it.
std::string html_page_start(const std::string& title, const std::string& head);
inline constexpr std::string_view HTML_PAGE_END = "</body></html>\n";

}  // namespace edgescout
