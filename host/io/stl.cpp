// Reads STL, binary and ASCII. Assimp is not used: a truncated file or a wrong count must be an
// error, but assimp loads as much as it can.
#include <cstdint>
#include <cstring>

#include "host/io/files.h"
#include "host/io/raw_mesh.h"
#include "host/io/text_tokens.h"
#include "kernels/error.h"

namespace edgescout {

namespace {

constexpr std::size_t header_bytes = 84;    // 80 of text, a 32-bit count
constexpr std::size_t triangle_bytes = 50;  // normal and corners as 12 floats, 2 bytes unused

void add_triangle(RawMesh& mesh, const Eigen::Vector3d (&corners)[3]) {
  const int first = static_cast<int>(mesh.vertices.size());
  mesh.vertices.insert(mesh.vertices.end(), corners, corners + 3);
  mesh.triangles.push_back({first, first + 1, first + 2});
}

std::uint64_t promised_bytes(const std::string& bytes) {
  std::uint32_t count = 0;
  std::memcpy(&count, bytes.data() + header_bytes - 4, sizeof count);
  return header_bytes + triangle_bytes * std::uint64_t{count};
}

RawMesh read_binary(const std::string& bytes) {
  RawMesh mesh;
  for (std::size_t at = header_bytes; at < bytes.size(); at += triangle_bytes) {
    float numbers[9];
    std::memcpy(numbers, bytes.data() + at + 12, sizeof numbers);
    Eigen::Vector3d corners[3];
    for (int i = 0; i < 3; ++i)
      corners[i] = {double{numbers[3 * i]}, double{numbers[3 * i + 1]}, double{numbers[3 * i + 2]}};
    add_triangle(mesh, corners);
  }
  return mesh;
}

// Reads: facet normal x y z, outer loop, three times vertex x y z, endloop, endfacet.
void read_facet(TextTokens& tokens, RawMesh& mesh) {
  tokens.expect("normal");
  for (int i = 0; i < 3; ++i) tokens.number("facet normal");
  tokens.expect("outer");
  tokens.expect("loop");
  Eigen::Vector3d corners[3];
  for (Eigen::Vector3d& corner : corners) {
    tokens.expect("vertex");
    for (int i = 0; i < 3; ++i) corner[i] = tokens.number("vertex coordinate");
  }
  tokens.expect("endloop");
  tokens.expect("endfacet");
  add_triangle(mesh, corners);
}

RawMesh read_ascii(const std::string& bytes, const std::string& source) {
  RawMesh mesh;
  TextTokens tokens(bytes, source);
  while (!tokens.at_end()) {  // a file may hold several solids
    tokens.expect("solid");
    tokens.skip_line();  // the name
    std::string_view word = tokens.word("facet or endsolid");
    for (; word == "facet"; word = tokens.word("facet or endsolid")) read_facet(tokens, mesh);
    if (word != "endsolid") tokens.fail("facet or endsolid", word);
    tokens.skip_line();
  }
  return mesh;
}

}  // namespace

RawMesh read_stl(const std::filesystem::path& file) {
  const std::string bytes = read_file(file), source = file.string();
  const bool has_header = bytes.size() >= header_bytes;
  // Binary files may start with "solid" too. The file is binary if its size fits the count.
  if (has_header && promised_bytes(bytes) == bytes.size()) return read_binary(bytes);
  const bool is_text = bytes.find_first_of(std::string("\0", 1)) == std::string::npos;
  const std::size_t start = bytes.find_first_not_of(" \t\r\n");
  if (is_text && start != std::string::npos && bytes.compare(start, 5, "solid") == 0)
    return read_ascii(bytes, source);
  if (!has_header)
    throw InputError(source, "STL header", std::to_string(bytes.size()) + " bytes",
                     "at least 84 bytes");
  const std::uint64_t promised = promised_bytes(bytes);
  throw InputError(
      source, "STL triangle count in the header",
      std::to_string((promised - header_bytes) / triangle_bytes) + " triangles and " +
          std::to_string(bytes.size()) + " bytes",
      std::to_string(promised) + " bytes for that count (" +
          (bytes.size() < promised ? "the file is truncated" : "the count is too small") + ")");
}

}  // namespace edgescout
