#include <yaml-cpp/eventhandler.h>
#include <yaml-cpp/yaml.h>

#include <algorithm>
#include <sstream>

#include "host/io/camera_tree.h"
#include "kernels/error.h"

namespace edgescout {

using nlohmann::json;

namespace {

InputError endless(const std::string& source) {
  return InputError(source, "YAML", "lists without an end", "a camera calibration");
}

// OpenCV's calibration writes all points of all images: some 10 bytes a number. More values than
// the file has room for are those of aliases, or of documents without an end.
std::size_t most_values(const std::string& text) { return 100'000 + text.size() / 4; }

InputError too_many(std::size_t most, const std::string& source) {
  return InputError(source, "YAML",
                    "more than " + std::to_string(most) + " values (lists without an end?)",
                    "a camera calibration");
}

// Aliases can repeat a part of the file without end.
struct YamlLimit {
  std::size_t most;
  std::size_t* values;
  int depth = 12;
};

json yaml_value(const YAML::Node& node, YamlLimit limit, const std::string& source);

// "<<: *other" takes the fields of another map, or of several, where this one has none of their
// name.
void add_merged(json& object, const json& other) {
  if (other.is_array())
    for (const json& element : other) add_merged(object, element);
  if (!other.is_object()) return;
  for (const auto& [key, value] : other.items())
    if (!object.contains(key)) object[key] = value;
}

json yaml_map(const YAML::Node& node, YamlLimit limit, const std::string& source) {
  constexpr const char* merge = "<<";
  json object = json::object();
  for (const auto& entry : node)
    add_field(object, entry.first.as<std::string>("?"), yaml_value(entry.second, limit, source),
              source);
  if (object.contains(merge)) {
    const json other = std::move(object[merge]);
    object.erase(merge);
    const auto is_map = [](const json& value) { return value.is_object(); };
    if (!is_map(other) && !(other.is_array() && std::ranges::all_of(other, is_map)))
      throw InputError(source, merge, other.dump(), "a map or a list of maps");
    add_merged(object, other);
  }
  return object;
}

json yaml_value(const YAML::Node& node, YamlLimit limit, const std::string& source) {
  if (--limit.depth < 0) throw endless(source);
  if (++*limit.values > limit.most) throw too_many(limit.most, source);
  if (node.IsMap()) return yaml_map(node, limit, source);
  if (node.IsSequence()) {
    json list = json::array();
    for (const YAML::Node& element : node) list.push_back(yaml_value(element, limit, source));
    return list;
  }
  return node.IsScalar() ? scalar_of(node.Scalar()) : json(nullptr);
}

// Stops at a text that has no end: the library finds one document after the other at a comma
// outside of a list, and would keep them all.
class EndlessCheck : public YAML::EventHandler {
 public:
  EndlessCheck(std::size_t most, std::string source) : most_(most), source_(std::move(source)) {}
  void OnDocumentStart(const YAML::Mark&) override { count(); }
  void OnDocumentEnd() override {}
  void OnNull(const YAML::Mark&, YAML::anchor_t) override { count(); }
  void OnAlias(const YAML::Mark&, YAML::anchor_t) override { count(); }
  void OnScalar(const YAML::Mark&, const std::string&, YAML::anchor_t,
                const std::string&) override {
    count();
  }
  void OnSequenceStart(const YAML::Mark&, const std::string&, YAML::anchor_t,
                       YAML::EmitterStyle::value) override {
    count();
  }
  void OnSequenceEnd() override {}
  void OnMapStart(const YAML::Mark&, const std::string&, YAML::anchor_t,
                  YAML::EmitterStyle::value) override {
    count();
  }
  void OnMapEnd() override {}

 private:
  void count() {
    if (++values_ > most_) throw too_many(most_, source_);
  }

  std::size_t most_;
  std::string source_;
  std::size_t values_ = 0;
};

void require_an_end(const std::string& text, const std::string& source) {
  std::istringstream stream(text);
  YAML::Parser parser(stream);
  EndlessCheck check(most_values(text), source);
  while (parser.HandleNextDocument(check)) continue;
}

// YAML forbids tabs before the first word of a line. Editors put them there all the same.
std::string without_leading_tabs(const std::string& text) {
  std::string spaced;
  bool is_leading = true;
  for (const char c : text) {
    if (c == '\t' && is_leading)
      spaced += "    ";
    else
      spaced += c;
    is_leading = c == '\n' || (is_leading && (c == ' ' || c == '\t'));
  }
  return spaced;
}

// OpenCV's first line ("%YAML:1.0") is no directive of YAML, and version 2 writes no "---" after
// it.
std::string without_opencv_line(const std::string& text) {
  const std::size_t start = text.find_first_not_of(" \t\n");
  if (start == std::string::npos || text.compare(start, 5, "%YAML") != 0) return text;
  const std::size_t end = text.find('\n', start);
  return end == std::string::npos ? "" : text.substr(end);
}

}  // namespace

json yaml_camera_tree(const std::string& text, const std::string& source) {
  try {
    json documents = json::array();
    std::size_t values = 0;
    const std::string yaml = without_leading_tabs(without_opencv_line(text));
    require_an_end(yaml, source);
    for (const YAML::Node& document : YAML::LoadAll(yaml))
      if (!document.IsNull())
        documents.push_back(
            yaml_value(document, {.most = most_values(yaml), .values = &values}, source));
    if (documents.size() == 1) return documents[0];
    return documents;
  } catch (const YAML::Exception& error) {
    throw InputError(source, "YAML", error.what(), "a camera calibration");
  }
}

}  // namespace edgescout
