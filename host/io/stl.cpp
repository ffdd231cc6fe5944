// Reads STL, binary and ASCII. Assimp is not used: a truncated file or a wrong count must be an
// error, but assimp loads as much as it can.
#include <algorithm>
#include <cstdint>
#include <cstring>

#include "host/core/log.h"
#include "host/io/files.h"
#include "host/io/lower_case.h"
#include "host/io/one_line.h"
#include "host/io/raw_mesh.h"
#include "host/io/text_tokens.h"
#include "kernels/error.h"

namespace edgescout {

namespace {

constexpr std::size_t header_bytes = 84;    // 80 of text, a 32-bit count
constexpr std::size_t triangle_bytes = 50;  // normal and corners as 12 floats, 2 bytes of colour

std::uint64_t promised_bytes(std::string_view bytes) {
  std::uint32_t count = 0;
  std::memcpy(&count, bytes.data() + header_bytes - 4, sizeof count);
  return header_bytes + triangle_bytes * std::uint64_t{count};
}

RawMesh read_binary(std::string_view triangles) {
  RawMesh mesh;
  mesh.vertices.reserve(3 * triangles.size() / triangle_bytes);
  mesh.triangles.reserve(triangles.size() / triangle_bytes);
  for (std::size_t at = 0; at < triangles.size(); at += triangle_bytes) {
    float numbers[9];
    std::memcpy(numbers, triangles.data() + at + 12, sizeof numbers);
    const int first = static_cast<int>(mesh.vertices.size());
    for (int i = 0; i < 9; i += 3)
      mesh.vertices.emplace_back(numbers[i], numbers[i + 1], numbers[i + 2]);
    mesh.triangles.push_back({first, first + 1, first + 2});
  }
  return mesh;
}

// Whether bytes after the triangles that the header counts may be dropped. Whole triangles must
// not: then the count is wrong.
bool is_padding(std::string_view rest) {
  return rest.size() % triangle_bytes != 0 ||
         std::ranges::all_of(rest, [](char c) { return c == '\0'; });
}

// Text whose count is that of its letters: another format, a page of a web server.
void refuse_text(std::string_view bytes, const std::string& source) {
  const bool is_text = std::ranges::all_of(
      bytes.substr(0, 1024), [](unsigned char c) { return c >= ' ' || (c >= '\t' && c <= '\r'); });
  if (!is_text) return;
  const std::string_view start = bytes.substr(0, 40);
  throw InputError(source, "STL", one_line("text that begins with " + std::string(start)),
                   "\"solid\" of ASCII STL, or binary STL");
}

RawMesh read_counted(std::string_view bytes, const std::string& source) {
  if (bytes.size() < header_bytes)
    throw InputError(source, "STL header", std::to_string(bytes.size()) + " bytes",
                     "at least 84 bytes");
  const std::uint64_t promised = promised_bytes(bytes), count = (promised - header_bytes) / 50;
  const bool is_short = bytes.size() < promised;
  if (is_short) refuse_text(bytes, source);
  if (is_short || (bytes.size() > promised && (count == 0 || !is_padding(bytes.substr(promised)))))
    throw InputError(
        source, "STL triangle count in the header",
        std::to_string(count) + " triangles and " + std::to_string(bytes.size()) + " bytes",
        std::to_string(promised) + " bytes for that count (" +
            (is_short ? "the file is truncated" : "the count is too small") + ")");
  if (bytes.size() > promised)
    log(LogLevel::Warning, source + ": " + std::to_string(bytes.size() - promised) +
                               " bytes after the last triangle are ignored");
  return read_binary(bytes.substr(header_bytes, promised - header_bytes));
}

// The words of ASCII STL, in any case. Some writers divide endsolid, endfacet and endloop.
class AsciiReader {
 public:
  AsciiReader(std::string_view text, const std::string& source) : tokens_(text, source) {}

  RawMesh read() {
    while (!tokens_.at_end()) read_solid();  // a file may hold several
    return std::move(mesh_);
  }

 private:
  std::string keyword(const char* what) {
    std::string word = lower_case(std::string(tokens_.word(what)));
    if (word == "end" && !tokens_.at_line_end())
      word += lower_case(std::string(tokens_.word(what)));
    return word;
  }
  void expect(const char* word) {
    if (const std::string found = keyword(word); found != word) tokens_.fail(word, found);
  }

  bool begins_facet() const {
    TextTokens ahead = tokens_;
    return lower_case(std::string(ahead.word("name"))) == "facet" && !ahead.at_end() &&
           lower_case(std::string(ahead.word("name"))) == "normal";
  }
  // It ends with the line, or where all of the file is one line, before the first facet.
  void skip_name() {
    while (!tokens_.at_line_end() && !begins_facet()) tokens_.word("name");
  }

  void read_solid() {
    expect("solid");
    skip_name();
    for (std::string word = keyword("facet or endsolid"); word != "endsolid";
         word = keyword("facet or endsolid")) {
      if (word == "facet")
        read_facet();
      else if (word == "color")  // of Materialise
        tokens_.skip_line();
      else
        tokens_.fail("facet or endsolid", word);
    }
    skip_name();
    if (!tokens_.at_line_end()) tokens_.fail("one solid in a line", "facet behind endsolid");
  }

  // Reads: facet normal x y z, outer loop, vertex x y z for each corner, endloop, endfacet. The
  // normal is not used, so it may hold what is no number.
  void read_facet() {
    constexpr int normal_words = 4;
    std::string word = keyword("outer loop");
    for (int skipped = 0; word != "outer"; ++skipped, word = keyword("outer loop"))
      if (skipped == normal_words) tokens_.fail("outer loop", word);
    expect("loop");
    std::vector<int> corners;
    for (word = keyword("vertex"); word == "vertex"; word = keyword("vertex or endloop")) {
      corners.push_back(static_cast<int>(mesh_.vertices.size()));
      Eigen::Vector3d& corner = mesh_.vertices.emplace_back();
      for (int axis = 0; axis < 3; ++axis) corner[axis] = tokens_.number("vertex coordinate");
    }
    if (corners.size() < 3 || word != "endloop")
      tokens_.fail(corners.size() < 3 ? "vertex" : "vertex or endloop", word);
    expect("endfacet");
    triangulate(corners, mesh_.vertices, mesh_.triangles);
  }

  TextTokens tokens_;
  RawMesh mesh_;
};

// Without a byte order mark and what DOS programs and disks add at the end.
std::string_view without_padding(std::string_view text) {
  if (text.starts_with("\xEF\xBB\xBF")) text.remove_prefix(3);
  constexpr std::string_view padding("\0\x1a", 2);
  while (!text.empty() && padding.find(text.back()) != std::string_view::npos)
    text.remove_suffix(1);
  return text;
}

bool is_ascii(std::string_view text) {
  constexpr std::string_view solid = "solid";
  const std::size_t start = text.find_first_not_of(" \t\r\n");
  return text.find('\0') == std::string_view::npos && start != std::string_view::npos &&
         lower_case(std::string(text.substr(start, solid.size()))) == solid;
}

}  // namespace

RawMesh read_stl(const std::filesystem::path& file) {
  const std::string bytes = read_file(file), source = file.string();
  // Binary files may start with "solid" too. The file is binary if its size fits the count.
  const bool fits = bytes.size() >= header_bytes && promised_bytes(bytes) == bytes.size();
  const std::string_view text = without_padding(bytes);
  return !fits && is_ascii(text) ? AsciiReader(text, source).read() : read_counted(bytes, source);
}

}  // namespace edgescout
