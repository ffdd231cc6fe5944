// Whether a text is well-formed XML, as far as the files written here use it: elements, attributes,
// text, the five entities.
#pragma once

#include <cctype>
#include <string>
#include <vector>

namespace edgescout::test {

class XmlReader {
 public:
  explicit XmlReader(const std::string& text) : text_(text) {}

  // Empty for a well-formed text with one root.
  std::string fault() {
    while (at_ < text_.size())
      if (const std::string found = text_[at_] == '<' ? tag() : character(); !found.empty())
        return found + " at " + std::to_string(at_) + ": " + text_.substr(at_, 60);
    if (!open_.empty()) return "<" + open_.back() + "> is not closed";
    return roots_ == 1 ? "" : std::to_string(roots_) + " roots";
  }

 private:
  std::string character() {
    if (text_[at_] == '>') return "a bare >";
    if (open_.empty() && !std::isspace(static_cast<unsigned char>(text_[at_])))
      return "text outside the root";
    return text_[at_] == '&' ? entity() : (++at_, "");
  }

  std::string entity() {
    for (const char* known : {"&amp;", "&lt;", "&gt;", "&quot;", "&apos;"})
      if (text_.compare(at_, std::string(known).size(), known) == 0)
        return at_ += std::string(known).size(), "";
    return "an unknown entity";
  }

  std::string name() {
    const std::size_t begin = at_;
    while (at_ < text_.size() && (std::isalnum(static_cast<unsigned char>(text_[at_])) ||
                                  text_[at_] == '-' || text_[at_] == ':'))
      ++at_;
    return text_.substr(begin, at_ - begin);
  }

  void skip_space() {
    while (at_ < text_.size() && std::isspace(static_cast<unsigned char>(text_[at_]))) ++at_;
  }

  std::string tag() {
    if (text_.compare(at_, 2, "</") == 0) return closing_tag();
    ++at_;
    const std::string element = name();
    if (element.empty()) return "an element without a name";
    std::vector<std::string> attributes;
    for (skip_space(); at_ < text_.size() && text_[at_] != '>' && text_[at_] != '/'; skip_space())
      if (const std::string found = attribute(attributes); !found.empty()) return found;
    if (open_.empty()) ++roots_;
    if (text_.compare(at_, 2, "/>") == 0) return at_ += 2, "";
    if (at_ >= text_.size() || text_[at_] != '>') return "a tag that does not end";
    ++at_;
    open_.push_back(element);
    return "";
  }

  std::string closing_tag() {
    at_ += 2;
    const std::string element = name();
    if (open_.empty() || open_.back() != element) return "</" + element + "> closes nothing";
    if (at_ >= text_.size() || text_[at_] != '>') return "a tag that does not end";
    ++at_;
    open_.pop_back();
    return "";
  }

  std::string attribute(std::vector<std::string>& known) {
    const std::string attribute_name = name();
    for (const std::string& other : known)
      if (other == attribute_name) return attribute_name + " twice";
    known.push_back(attribute_name);
    if (attribute_name.empty() || text_.compare(at_, 2, "=\"") != 0)
      return "an attribute without a value";
    for (at_ += 2; at_ < text_.size() && text_[at_] != '"';) {
      if (text_[at_] == '<') return "< in an attribute";
      if (text_[at_] != '&')
        ++at_;
      else if (const std::string found = entity(); !found.empty())
        return found;
    }
    if (at_ >= text_.size()) return "an attribute that does not end";
    ++at_;
    return "";
  }

  const std::string& text_;
  std::size_t at_ = 0;
  int roots_ = 0;
  std::vector<std::string> open_;
};

inline std::string fault_of_xml(const std::string& text) { return XmlReader(text).fault(); }

}  // namespace edgescout::test
