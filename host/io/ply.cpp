// Reads PLY, text and binary of either byte order. Assimp is not used: it invents the missing data
// of a truncated file.
#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <limits>
#include <optional>

#include "host/io/files.h"
#include "host/io/raw_mesh.h"
#include "host/io/text_tokens.h"
#include "kernels/error.h"

namespace edgescout {

namespace {

struct Property {
  std::string name;
  char type = 'f';  // b, h, i: signed of 1, 2, 4 bytes; B, H, I: unsigned; f, d: float, double
  char count_type = '\0';  // of a list
};

struct Element {
  std::string name;
  int count = 0;
  std::vector<Property> properties;
};

enum class Storage { Text, LittleEndian, BigEndian };

struct Header {
  Storage storage = Storage::Text;
  std::vector<Element> elements;
};

char type_code(TextTokens& tokens) {
  const std::string_view word = tokens.word("property type");
  if (word == "char" || word == "int8") return 'b';
  if (word == "uchar" || word == "uint8") return 'B';
  if (word == "short" || word == "int16") return 'h';
  if (word == "ushort" || word == "uint16") return 'H';
  if (word == "int" || word == "int32") return 'i';
  if (word == "uint" || word == "uint32") return 'I';
  if (word == "float" || word == "float32") return 'f';
  if (word == "double" || word == "float64") return 'd';
  tokens.fail("a PLY property type", word);
}

Storage read_storage(TextTokens& tokens) {
  const std::string_view word = tokens.word("PLY format");
  if (word == "ascii") return Storage::Text;
  if (word == "binary_little_endian") return Storage::LittleEndian;
  if (word == "binary_big_endian") return Storage::BigEndian;
  tokens.fail("ascii, binary_little_endian or binary_big_endian", word);
}

Property read_property(TextTokens& tokens) {
  Property property;
  TextTokens ahead = tokens;
  if (ahead.word("property type") == "list") {
    tokens.expect("list");
    property.count_type = type_code(tokens);
  }
  property.type = type_code(tokens);
  property.name = tokens.word("property name");
  return property;
}

Header read_header(std::string_view text, const std::string& source) {
  TextTokens tokens(text, source);
  Header header;
  tokens.expect("ply");
  tokens.expect("format");
  header.storage = read_storage(tokens);
  tokens.expect("1.0");
  for (std::string_view word = tokens.word("end_header"); word != "end_header";
       word = tokens.word("end_header")) {
    if (word == "comment" || word == "obj_info") {
      tokens.skip_line();
    } else if (word == "element") {
      const std::string name(tokens.word("element name"));
      header.elements.push_back({name, tokens.count("element count"), {}});
    } else if (word == "property" && !header.elements.empty()) {
      header.elements.back().properties.push_back(read_property(tokens));
    } else {
      tokens.fail("element, property, comment or end_header", word);
    }
  }
  return header;
}

// Reads the numbers of the body one after the other, from text or binary.
class Numbers {
 public:
  Numbers(std::string_view body, Storage storage, const std::string& source)
      : body_(body),
        source_(source),
        swapped_((storage == Storage::BigEndian) != (std::endian::native == std::endian::big)) {
    if (storage == Storage::Text) text_.emplace(body, source + ": body");
  }

  double next(char type, const char* what) {
    if (text_) return text_->number(what);
    switch (type) {
      case 'b':
        return take<std::int8_t>(what);
      case 'B':
        return take<std::uint8_t>(what);
      case 'h':
        return take<std::int16_t>(what);
      case 'H':
        return take<std::uint16_t>(what);
      case 'i':
        return take<std::int32_t>(what);
      case 'I':
        return take<std::uint32_t>(what);
      case 'f':
        return take<float>(what);
      default:
        return take<double>(what);
    }
  }
  int next_integer(char type, const char* what) {
    const double value = next(type, what);
    if (value != std::floor(value) || std::abs(value) > std::numeric_limits<int>::max())
      throw InputError(source_, what, std::to_string(value), "a whole number");
    return static_cast<int>(value);
  }
  void require_end() {
    if (text_ ? !text_->at_end() : at_ != body_.size())
      throw InputError(source_, "PLY counts", "more data than the header says",
                       "the counts of the header");
  }

 private:
  template <typename T>
  T take(const char* what) {
    if (body_.size() - at_ < sizeof(T))
      throw InputError(source_, what, "the end of the file (truncated?)",
                       "the counts of the header");
    char bytes[sizeof(T)];
    std::memcpy(bytes, body_.data() + at_, sizeof(T));
    if (swapped_) std::reverse(bytes, bytes + sizeof(T));
    at_ += sizeof(T);
    T value;
    std::memcpy(&value, bytes, sizeof(T));
    return value;
  }

  std::string_view body_;
  std::string source_;
  bool swapped_;
  std::optional<TextTokens> text_;
  std::size_t at_ = 0;
};

std::vector<int> read_list(Numbers& numbers, const Property& property) {
  std::vector<int> list;
  for (int n = numbers.next_integer(property.count_type, "list length"); n > 0; --n)
    list.push_back(numbers.next_integer(property.type, "list entry"));
  return list;
}

bool is_corners(const Property& property) {
  return property.count_type &&
         (property.name == "vertex_indices" || property.name == "vertex_index");
}

void read_row(const Element& element, Numbers& numbers, Eigen::Vector3d& vertex,
              std::vector<int>& corners) {
  for (const Property& property : element.properties) {
    if (property.count_type) {
      std::vector<int> list = read_list(numbers, property);
      if (is_corners(property)) corners = std::move(list);
      continue;
    }
    const double value = numbers.next(property.type, element.name.c_str());
    if (property.name.size() == 1 && property.name[0] >= 'x' && property.name[0] <= 'z')
      vertex[property.name[0] - 'x'] = value;
  }
}

void require_coordinates(const Element& vertex, const std::string& source) {
  for (const char* axis : {"x", "y", "z"})
    if (std::ranges::none_of(vertex.properties,
                             [&](const Property& p) { return p.name == axis && !p.count_type; }))
      throw InputError(source, "PLY header", std::string("vertices without ") + axis, "x, y and z");
}

// A count must not be larger than the number of bytes in the file allows.
void require_properties(const Header& header, const std::string& source) {
  for (const Element& element : header.elements) {
    if (element.name == "vertex") require_coordinates(element, source);
    if (element.name == "face" && std::ranges::none_of(element.properties, is_corners))
      throw InputError(source, "PLY header", "faces without vertex_indices", "a list of them");
    if (element.count > 0 && element.properties.empty())
      throw InputError(
          source, "PLY header",
          std::to_string(element.count) + " of " + element.name + " without a property",
          "one at least");
  }
}

void add_face(RawMesh& mesh, const std::vector<int>& corners, int face, const std::string& source) {
  for (int corner : corners)
    if (corner < 0 || corner >= static_cast<int>(mesh.vertices.size()))
      throw InputError(source, "face " + std::to_string(face),
                       "vertex index " + std::to_string(corner),
                       "an index below " + std::to_string(mesh.vertices.size()));
  triangulate(corners, mesh.vertices, mesh.triangles);
}

}  // namespace

RawMesh read_ply(const std::filesystem::path& file) {
  const std::string bytes = read_file(file), source = file.string();
  const std::size_t mark = bytes.find("end_header");
  const std::size_t end = mark == std::string::npos ? mark : bytes.find('\n', mark);
  if (!bytes.starts_with("ply") || end == std::string::npos)
    throw InputError(source, "PLY header", "no whole header", "\"ply\" ... \"end_header\"");
  const Header header = read_header(std::string_view(bytes).substr(0, end), source);
  require_properties(header, source);
  Numbers numbers(std::string_view(bytes).substr(end + 1), header.storage, source);
  RawMesh mesh;
  // Kept until all vertices are known: the elements may stand in any order.
  std::vector<std::vector<int>> faces;
  for (const Element& element : header.elements)
    for (int i = 0; i < element.count; ++i) {
      Eigen::Vector3d vertex = Eigen::Vector3d::Zero();
      std::vector<int> corners;
      read_row(element, numbers, vertex, corners);
      if (element.name == "vertex") mesh.vertices.push_back(vertex);
      if (element.name == "face") faces.push_back(std::move(corners));
    }
  numbers.require_end();
  for (std::size_t i = 0; i < faces.size(); ++i)
    add_face(mesh, faces[i], static_cast<int>(i), source);
  return mesh;
}

}  // namespace edgescout
