#include "host/cli/page_parts.h"

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

std::string html_page(const std::string& title, const std::string& head, const std::string& body) {
  return std::string(
             "<!doctype html>\n<html lang=en><head><meta charset=utf-8><meta name=viewport "
             "content='width=device-width'><title>") +
         title + "</title><style>" + PAGE_STYLE + "</style>" + head + "</head><body>" + body +
         "</body></html>\n";
}

}  // namespace edgescout
