// Reads the part of XML that calibrations use: elements, attributes, text, comments. OpenCV's own
// reader accepts only its own dialect.
#include <cctype>

#include "host/io/camera_tree.h"
#include "kernels/error.h"

namespace edgescout {

using nlohmann::json;

namespace {

class XmlReader {
 public:
  XmlReader(std::string_view text, const std::string& source) : text_(text), source_(source) {}

  // The content of the outermost element.
  json document() {
    skip_others();
    std::string name;
    json content = element(name, 0);
    skip_others();
    if (at_ != text_.size()) fail("text after the last element");
    return content;
  }

 private:
  [[noreturn]] void fail(const std::string& found) const {
    throw InputError(source_, "XML", found, "a camera calibration as OpenCV writes it");
  }
  void skip_blanks() {
    while (at_ < text_.size() && std::isspace(static_cast<unsigned char>(text_[at_]))) ++at_;
  }
  void skip_past(std::string_view mark) {
    at_ = text_.find(mark, at_);
    if (at_ == std::string_view::npos) fail("no \"" + std::string(mark) + "\"");
    at_ += mark.size();
  }
  bool starts(std::string_view mark) const { return text_.substr(at_).starts_with(mark); }
  // Blanks, comments, <?xml ..?> and <!DOCTYPE ..>.
  void skip_others() {
    for (skip_blanks(); starts("<?") || starts("<!"); skip_blanks())
      skip_past(starts("<!--") ? "-->" : ">");
  }
  std::string word() {
    const std::size_t from = at_;
    while (at_ < text_.size() &&
           (std::isalnum(static_cast<unsigned char>(text_[at_])) || text_[at_] == '_' ||
            text_[at_] == '-' || text_[at_] == '.' || text_[at_] == ':'))
      ++at_;
    if (at_ == from) fail("no name at character " + std::to_string(from));
    return std::string(text_.substr(from, at_ - from));
  }

  // <name a="1">content</name> or <name a="1"/>.
  json element(std::string& name, int depth) {
    if (depth > 12) fail("elements nested too deep");
    if (!starts("<")) fail("no element");
    ++at_;
    name = word();
    json fields = json::object();
    for (skip_blanks(); !starts(">") && !starts("/>"); skip_blanks()) attribute(fields);
    const bool is_empty = starts("/>");
    at_ += is_empty ? 2 : 1;
    if (is_empty) return fields.empty() ? json(nullptr) : fields;
    const std::string text = content(fields, depth);
    if (at_ + 2 > text_.size()) fail("no end of <" + name + ">");
    at_ += 2;
    if (word() != name) fail("another end than </" + name + ">");
    skip_blanks();
    if (!starts(">")) fail("no end of </" + name + ">");
    ++at_;
    if (!fields.empty()) return fields;
    return value_of(text);
  }

  void attribute(json& fields) {
    const std::string name = word();
    skip_blanks();
    if (!starts("=")) fail("an attribute " + name + " without a value");
    ++at_;
    skip_blanks();
    if (!starts("\"") && !starts("'")) fail("an attribute " + name + " without quotes");
    const char quote = text_[at_++];
    const std::size_t end = text_.find(quote, at_);
    if (end == std::string_view::npos) fail("an attribute " + name + " without an end");
    const std::string value(text_.substr(at_, end - at_));
    at_ = end + 1;
    if (name != "type_id") add_field(fields, name, scalar_of(value), source_);
  }

  // Adds the elements within; returns the text between them.
  std::string content(json& fields, int depth) {
    std::string text;
    json unnamed = json::array();
    while (at_ < text_.size() && !starts("</")) {
      if (starts("<!") || starts("<?")) {
        skip_others();
      } else if (starts("<")) {
        std::string name;
        json value = element(name, depth + 1);
        if (name == "_")  // OpenCV's element of a list
          unnamed.push_back(std::move(value));
        else
          add_element(fields, name, std::move(value));
      } else {
        text += text_[at_++];
      }
    }
    if (!unnamed.empty()) add_field(fields, "list", std::move(unnamed), source_);
    return text;
  }

  // Elements of one name that have elements of their own are a list.
  void add_element(json& fields, const std::string& name, json value) const {
    if (!fields.contains(name) || !value.is_object())
      return add_field(fields, name, std::move(value), source_);
    json& first = fields[name];
    if (first.is_object()) first = json::array({first});
    if (!first.is_array()) throw InputError(source_, name, "the field twice", "it once");
    first.push_back(std::move(value));
  }

  static json value_of(const std::string& text) {
    const std::size_t from = text.find_first_not_of(" \t\n");
    if (from == std::string::npos) return nullptr;
    return value_in(text.substr(from, text.find_last_not_of(" \t\n") + 1 - from));
  }

  std::string_view text_;
  std::string source_;
  std::size_t at_ = 0;
};

}  // namespace

json xml_camera_tree(std::string_view text, const std::string& source) {
  return XmlReader(text, source).document();
}

}  // namespace edgescout
