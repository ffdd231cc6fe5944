#include "host/cli/page_parts.h"

#include <algorithm>
#include <cstdint>

#include "host/cli/page_style.h"

namespace edgescout {

std::string escaped_html(const std::string& text) {
  std::string out;
  for (const char c : text)
    out += c == '<'   ? "&lt;"
           : c == '>' ? "&gt;"
           : c == '&' ? "&amp;"
           : c == '"' ? "&quot;"
                      : std::string(1, c);
  return out;
}

std::string tile(const std::string& value, const std::string& label) {
  return "<div class=tile><b>" + value + "</b><span>" + label + "</span></div>";
}

std::string base64(std::string_view bytes) {
  constexpr char letters[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text;
  text.reserve(bytes.size() / 3 * 4 + 4);
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    const std::size_t count = std::min<std::size_t>(3, bytes.size() - i);
    std::uint32_t word = 0;
    for (std::size_t k = 0; k < 3; ++k)
      word = word << 8 | (k < count ? static_cast<unsigned char>(bytes[i + k]) : 0u);
    for (std::size_t k = 0; k < 4; ++k)
      text += k <= count ? letters[word >> (18 - 6 * k) & 63] : '=';
  }
  return text;
}

std::string html_page_start(const std::string& title, const std::string& head) {
  return std::string(
             "<!doctype html>\n<html lang=en><head><meta charset=utf-8><meta name=viewport "
             "content='width=device-width'><title>") +
         title + "</title><style>" + PAGE_STYLE + "</style>" + head + "</head><body>";
}

std::string html_page(const std::string& title, const std::string& head, const std::string& body) {
  return html_page_start(title, head) + body + std::string(HTML_PAGE_END);
}

}  // namespace edgescout
