// Reads OFF of Geomview, as text. Colours, normals and texture are not used. Assimp is not used: it
// takes a truncated file for a whole one.
#include <cctype>

#include "host/io/files.h"
#include "host/io/raw_mesh.h"
#include "host/io/text_tokens.h"
#include "kernels/error.h"

namespace edgescout {

namespace {

// With blanks in place of comments, so that lines keep their numbers.
std::string without_comments(std::string text) {
  for (std::size_t at = text.find('#'); at != std::string::npos; at = text.find('#', at))
    while (at < text.size() && text[at] != '\n' && text[at] != '\r') text[at++] = ' ';
  return text;
}

// ModelNet's files have the counts right behind OFF. The word may be missing.
std::string with_divided_keyword(std::string text) {
  const std::size_t start = text.find_first_not_of(" \t\r\n");
  if (start == std::string::npos) return text;
  const auto is_digit = [&](std::size_t at) {
    return at < text.size() && std::isdigit(static_cast<unsigned char>(text[at]));
  };
  if (is_digit(start) && text.compare(start, 4, "4OFF") != 0) return text.insert(start, "OFF ");
  const std::size_t end = text.find("OFF", start);
  if (end != std::string::npos && is_digit(end + 3)) text.insert(end + 3, " ");
  return text;
}

}  // namespace

RawMesh read_off(const std::filesystem::path& file) {
  const std::string text = with_divided_keyword(without_comments(read_file(file))),
                    source = file.string();
  TextTokens tokens(text, source);
  const std::string_view word = tokens.word("OFF");
  // Other letters before OFF say what follows the coordinates in their lines.
  if (!word.ends_with("OFF") || word.find_first_of("4n") != std::string_view::npos)
    tokens.fail("OFF of three dimensions", word);
  TextTokens ahead = tokens;
  if (ahead.word("number of vertices") == "BINARY") tokens.fail("OFF as text", "BINARY");
  const int vertices = tokens.count("number of vertices"), faces = tokens.count("number of faces");
  tokens.skip_line();  // the number of edges, which may be missing
  RawMesh mesh;
  for (int i = 0; i < vertices; ++i) {
    Eigen::Vector3d& x = mesh.vertices.emplace_back();
    for (int axis = 0; axis < 3; ++axis) x[axis] = tokens.number("vertex coordinate");
    tokens.skip_line();
  }
  std::vector<int> corners;
  for (int i = 0; i < faces; ++i) {
    const int size = tokens.count("number of corners");
    corners.push_back(size);
    for (int k = 0; k < size; ++k) corners.push_back(tokens.count("vertex index"));
    tokens.skip_line();
  }
  if (!tokens.at_end()) tokens.fail("the end of the file", tokens.word("end"));
  add_polygons(corners, 0, source, mesh);
  return mesh;
}

}  // namespace edgescout
