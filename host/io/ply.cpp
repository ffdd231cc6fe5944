// Reads PLY, text and binary of either byte order. Assimp is not used: it invents the missing data
// of a truncated file.
#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <limits>
#include <optional>

#include "host/core/log.h"
#include "host/io/files.h"
#include "host/io/ply_header.h"
#include "host/io/raw_mesh.h"
#include "host/io/text_tokens.h"
#include "kernels/error.h"

namespace edgescout {

namespace {

// Reads the numbers of the body one after the other, from text or binary.
class Numbers {
 public:
  Numbers(std::string_view body, PlyStorage storage, const std::string& source)
      : body_(body),
        source_(source),
        swapped_((storage == PlyStorage::BigEndian) != (std::endian::native == std::endian::big)) {
    if (storage != PlyStorage::Text) return;
    constexpr std::string_view padding("\0\x1a", 2);  // as DOS programs and disks add it
    text_.emplace(body.substr(0, body.find_last_not_of(padding) + 1), source + ": body");
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
      case 'q':
        return static_cast<double>(take<std::int64_t>(what));
      case 'Q':
        return static_cast<double>(take<std::uint64_t>(what));
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
  // The length of a list that fits in the rest of the file.
  int next_length(const PlyProperty& list) {
    const int length = next_integer(list.count_type, "list length");
    if (length < 0)
      throw InputError(source_, "list length", std::to_string(length), "0 or a larger number");
    return length;
  }
  // Words of text that are no numbers are skipped too.
  void skip(char type, const char* what) {
    if (text_)
      text_->word(what);
    else
      next(type, what);
  }
  // Warns of bytes that follow the last row but cannot be one. InputError: others.
  void require_end(std::size_t row_bytes) {
    const std::size_t rest = text_ ? 0 : body_.size() - at_;
    const std::string_view bytes = body_.substr(body_.size() - rest);
    const bool is_padding = rest < row_bytes || bytes.find_first_not_of(std::string_view(
                                                    "\0\r\n", 3)) == std::string_view::npos;
    if (text_ ? !text_->at_end() : !is_padding)
      throw InputError(source_, "PLY counts", "more data than the header says",
                       "the counts of the header");
    if (rest > 0)
      log(LogLevel::Warning,
          source_ + ": " + std::to_string(rest) + " bytes after the last row are ignored");
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

bool is_corners(const PlyProperty& property) {
  return property.count_type &&
         (property.name == "vertex_indices" || property.name == "vertex_index");
}

bool is_coordinate(const PlyProperty& property) {
  return !property.count_type && property.name.size() == 1 && property.name[0] >= 'x' &&
         property.name[0] <= 'z';
}

void require_coordinates(const PlyElement& vertex, const std::string& source) {
  for (const char* axis : {"x", "y", "z"})
    if (std::ranges::none_of(vertex.properties,
                             [&](const PlyProperty& p) { return p.name == axis && !p.count_type; }))
      throw InputError(source, "PLY header", std::string("vertices without ") + axis, "x, y and z");
}

// A count must not be larger than the number of bytes in the file allows.
void require_properties(const PlyHeader& header, std::size_t body_bytes,
                        const std::string& source) {
  for (const PlyElement& element : header.elements) {
    if (element.name == "vertex") require_coordinates(element, source);
    if ((element.name == "face" || element.name == "tristrips") &&
        std::ranges::none_of(element.properties, is_corners))
      throw InputError(source, "PLY header", element.name + " without vertex_indices",
                       "a list of them");
    const std::string rows = std::to_string(element.count) + " of " + element.name;
    if (element.count > 0 && element.properties.empty())
      throw InputError(source, "PLY header", rows + " without a property", "one at least");
    // The last number of a text needs no blank.
    if (static_cast<std::size_t>(element.count) >
        (body_bytes + 1) / std::max<std::size_t>(1, least_bytes(element, header.storage)))
      throw InputError(source, "PLY header",
                       rows + " and " + std::to_string(body_bytes) + " bytes (truncated?)",
                       "a count that fits in the file");
  }
}

// The corners of faces and strips. They are kept until all vertices are known: the elements may
// stand in any order. The number of its corners precedes a face, -1 ends a strip.
struct CornerLists {
  std::vector<int> faces, strips;
};

class BodyReader {
 public:
  BodyReader(const PlyHeader& header, std::string_view body, const std::string& source)
      : numbers_(body, header.storage, source), source_(source) {
    std::size_t largest_row = 0;
    for (const PlyElement& element : header.elements) {
      if (element.name == "vertex") mesh_.vertices.reserve(std::size_t(element.count));
      for (int i = 0; i < element.count; ++i) read_row(element);
      if (element.count > 0)
        largest_row = std::max(largest_row, least_bytes(element, header.storage));
    }
    numbers_.require_end(largest_row);
  }

  RawMesh mesh() {
    add_polygons(lists_.faces, 0, source_, mesh_);
    add_strips();
    return std::move(mesh_);
  }

 private:
  void read_row(const PlyElement& element) {
    const bool is_vertex = element.name == "vertex";
    if (is_vertex) mesh_.vertices.emplace_back(0, 0, 0);
    for (const PlyProperty& property : element.properties) {
      if (property.count_type)
        read_list(element, property);
      else if (is_vertex && is_coordinate(property))
        mesh_.vertices.back()[property.name[0] - 'x'] =
            numbers_.next(property.type, "vertex coordinate");
      else
        numbers_.skip(property.type, element.name.c_str());
    }
  }

  void read_list(const PlyElement& element, const PlyProperty& property) {
    const int length = numbers_.next_length(property);
    const bool is_face = element.name == "face", is_strip = element.name == "tristrips";
    if (!is_corners(property) || !(is_face || is_strip)) {
      for (int i = 0; i < length; ++i) numbers_.skip(property.type, "list entry");
      return;
    }
    std::vector<int>& kept = is_face ? lists_.faces : lists_.strips;
    if (is_face) kept.push_back(length);
    for (int i = 0; i < length; ++i)
      kept.push_back(numbers_.next_integer(property.type, "list entry"));
    if (is_strip) kept.push_back(-1);
  }

  void require_strip_corner(int corner) const {
    if (corner < 0 || corner >= static_cast<int>(mesh_.vertices.size()))
      throw InputError(source_, "tristrips", "vertex index " + std::to_string(corner),
                       "-1 or an index below " + std::to_string(mesh_.vertices.size()));
  }

  // Each corner after the second makes a triangle with the two before it. Every other one of these
  // runs the other way round.
  void add_strips() {
    const std::vector<int>& strips = lists_.strips;
    std::size_t first = 0;
    for (std::size_t i = 0; i < strips.size(); ++i) {
      if (strips[i] == -1) {
        first = i + 1;
        continue;
      }
      require_strip_corner(strips[i]);
      if (i < first + 2) continue;
      const bool turned = (i - first) % 2 == 1;
      mesh_.triangles.push_back(
          {strips[i - (turned ? 1 : 2)], strips[i - (turned ? 2 : 1)], strips[i]});
    }
  }

  Numbers numbers_;
  const std::string& source_;
  RawMesh mesh_;
  CornerLists lists_;
};

}  // namespace

RawMesh read_ply(const std::filesystem::path& file) {
  std::string bytes = read_file(file);
  if (bytes.starts_with("\xEF\xBB\xBF")) bytes.erase(0, 3);
  const std::string source = file.string();
  const PlyHeader header = read_ply_header(bytes, source);
  const std::string_view body = std::string_view(bytes).substr(header.bytes);
  require_properties(header, body.size(), source);
  return BodyReader(header, body, source).mesh();
}

}  // namespace edgescout
