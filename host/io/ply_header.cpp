#include "host/io/ply_header.h"

#include <algorithm>
#include <cctype>

#include "host/io/text_tokens.h"
#include "kernels/error.h"

namespace edgescout {

namespace {

char type_code(TextTokens& tokens) {
  constexpr struct {
    std::string_view name, other;
    char code;
  } types[] = {{"char", "int8", 'b'},     {"uchar", "uint8", 'B'},  {"short", "int16", 'h'},
               {"ushort", "uint16", 'H'}, {"int", "int32", 'i'},    {"uint", "uint32", 'I'},
               {"long", "int64", 'q'},    {"ulong", "uint64", 'Q'}, {"float", "float32", 'f'},
               {"double", "float64", 'd'}};
  const std::string_view word = tokens.word("property type");
  for (const auto& type : types)
    if (word == type.name || word == type.other) return type.code;
  tokens.fail("a PLY property type", word);
}

PlyStorage read_storage(TextTokens& tokens) {
  const std::string_view word = tokens.word("PLY format");
  if (word == "ascii") return PlyStorage::Text;
  if (word == "binary_little_endian") return PlyStorage::LittleEndian;
  if (word == "binary_big_endian") return PlyStorage::BigEndian;
  tokens.fail("ascii, binary_little_endian or binary_big_endian", word);
}

PlyProperty read_property(TextTokens& tokens) {
  PlyProperty property;
  TextTokens ahead = tokens;
  if (ahead.word("property type") == "list") {
    tokens.expect("list");
    property.count_type = type_code(tokens);
  }
  property.type = type_code(tokens);
  property.name = tokens.word("property name");
  return property;
}

// Calls visit(line) for the lines after "ply" until it returns false. Returns the number of bytes
// of the lines.
template <typename Visit>
std::size_t visit_lines(std::string_view file, const std::string& source, Visit visit) {
  const std::size_t first = file.find_first_of("\r\n");
  if (!file.starts_with("ply") || first == std::string_view::npos)
    throw InputError(source, "PLY header", "no line \"ply\"", "\"ply\" ... \"end_header\"");
  const std::string_view line_end = file.substr(first).starts_with("\r\n") ? "\r\n"
                                    : file[first] == '\r'                  ? "\r"
                                                                           : "\n";
  for (std::size_t at = 0;;) {
    const std::size_t end = file.find(line_end, at);
    if (end == std::string_view::npos)
      throw InputError(source, "PLY header", "no line \"end_header\"",
                       "\"ply\" ... \"end_header\"");
    const bool goes_on = visit(file.substr(at, end - at));
    at = end + line_end.size();
    if (!goes_on) return at;
  }
}

class HeaderReader {
 public:
  explicit HeaderReader(const std::string& source) : source_(source) {}

  // Returns whether the header goes on.
  bool read(std::string_view line) {
    TextTokens tokens(line, source_, ++line_);
    if (tokens.at_end()) return true;
    const std::string_view word = tokens.word("a keyword");
    if (word == "comment" || word == "obj_info") return true;
    if (line_ == 1 && word == "ply") return true;
    if (word == "end_header") return false;
    if (word == "format") {
      has_format_ = true;
      header.storage = read_storage(tokens);
      tokens.expect("1.0");
    } else if (word == "element") {
      const std::string name(tokens.word("element name"));
      header.elements.push_back({name, tokens.count("element count"), {}});
    } else if (word == "property" && !header.elements.empty()) {
      header.elements.back().properties.push_back(read_property(tokens));
    } else {
      tokens.fail("format, element, property, comment or end_header", word);
    }
    return true;
  }
  void require_format() const {
    if (!has_format_) throw InputError(source_, "PLY header", "no format", "format ascii 1.0");
  }
  PlyHeader header;

 private:
  const std::string& source_;
  int line_ = 0;
  bool has_format_ = false;
};

}  // namespace

PlyHeader read_ply_header(std::string_view file, const std::string& source) {
  HeaderReader reader(source);
  reader.header.bytes =
      visit_lines(file, source, [&](std::string_view line) { return reader.read(line); });
  reader.require_format();
  return std::move(reader.header);
}

std::size_t least_bytes(char type, PlyStorage storage) {
  if (storage == PlyStorage::Text) return 2;
  switch (std::tolower(static_cast<unsigned char>(type))) {
    case 'b':
      return 1;
    case 'h':
      return 2;
    case 'i':
    case 'f':
      return 4;
    default:
      return 8;
  }
}

std::size_t least_bytes(const PlyElement& element, PlyStorage storage) {
  std::size_t sum = 0;
  for (const PlyProperty& property : element.properties)
    sum += least_bytes(property.count_type ? property.count_type : property.type, storage);
  return sum;
}

}  // namespace edgescout
