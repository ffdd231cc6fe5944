// Reads the polygons of Wavefront OBJ. Materials, normals, texture, colours, lines and points are
// not used. Assimp is not used: it takes numbers with a comma and cut lines without a word, and
// refuses comments behind a face.
#include <algorithm>
#include <charconv>

#include "host/core/log.h"
#include "host/io/files.h"
#include "host/io/raw_mesh.h"
#include "host/io/text_tokens.h"
#include "kernels/error.h"

namespace edgescout {

namespace {

// Which make a surface without polygons.
bool is_free_form(std::string_view keyword) {
  for (const char* surface : {"surf", "res", "cdp", "bsp", "bzp"})
    if (keyword == surface) return true;
  return false;
}

// A comment begins a line or follows a blank: 1.#QNAN is a word.
std::string_view without_comment(std::string_view line) {
  std::size_t mark = line.find('#');
  while (mark != std::string_view::npos && mark > 0 && line[mark - 1] != ' ' &&
         line[mark - 1] != '\t')
    mark = line.find('#', mark + 1);
  return line.substr(0, mark);
}

class ObjReader {
 public:
  explicit ObjReader(const std::string& source) : source_(source) {}

  void read(std::string_view line, int number) {
    TextTokens tokens(without_comment(line), source_, number);
    if (tokens.at_end()) return;
    const std::string_view keyword = tokens.word("keyword");
    if (keyword == "v")
      read_vertex(tokens);
    else if (keyword == "f" || keyword == "fo")  // the latter is of version 2
      read_face(tokens);
    else if (!warned_ && is_free_form(keyword))
      warn("a free-form surface (" + std::string(keyword) + ") in line " + std::to_string(number) +
           " is left out: export polygons");
  }

  RawMesh mesh() {
    add_polygons(faces_, 1, source_, mesh_);
    return std::move(mesh_);
  }

 private:
  void warn(const std::string& what) {
    log(LogLevel::Warning, source_ + ": " + what);
    warned_ = true;
  }

  // A weight or a colour may follow.
  void read_vertex(TextTokens& tokens) {
    Eigen::Vector3d& vertex = mesh_.vertices.emplace_back();
    for (int axis = 0; axis < 3; ++axis) vertex[axis] = tokens.number("vertex coordinate");
  }

  // A corner is v, v/vt, v//vn or v/vt/vn.
  void read_face(TextTokens& tokens) {
    const std::size_t start = faces_.size();
    faces_.push_back(0);
    while (!tokens.at_end()) {
      const std::string_view word = tokens.word("corner");
      const std::string_view digits = word.substr(0, word.find('/'));
      int index = 0;
      const auto [end, error] =
          std::from_chars(digits.data(), digits.data() + digits.size(), index);
      if (error != std::errc{} || end != digits.data() + digits.size())
        tokens.fail("a vertex index", word);
      faces_.push_back(absolute(index, tokens, word));
    }
    faces_[start] = static_cast<int>(faces_.size() - start) - 1;
    if (faces_[start] < 3) tokens.fail("three corners or more", std::to_string(faces_[start]));
  }

  // Negative indices count back from the last vertex so far.
  int absolute(int index, const TextTokens& tokens, std::string_view word) const {
    if (index > 0) return index;
    const int count = static_cast<int>(mesh_.vertices.size());
    if (index == 0 || index < -count)
      tokens.fail("a vertex index from 1, or from -1 to -" + std::to_string(count), word);
    return count + 1 + index;
  }

  std::string source_;
  RawMesh mesh_;
  std::vector<int> faces_;
  bool warned_ = false;
};

// Calls visit(line, number). A backslash at its end joins a line with the next one.
template <typename Visit>
void visit_lines(std::string text, Visit visit) {
  constexpr std::string_view line_ends = "\r\n";
  int number = 1;
  for (std::size_t at = 0; at < text.size();) {
    const int first = number;
    std::size_t end = at, next = at;
    for (bool goes_on = true; goes_on; ++number) {
      end = std::min(text.find_first_of(line_ends, next), text.size());
      next = std::min(text.size(), end + (text.compare(end, 2, line_ends) == 0 ? 2 : 1));
      goes_on = end > at && text[end - 1] == '\\';
      if (goes_on)
        std::fill(text.begin() + std::ptrdiff_t(end) - 1, text.begin() + std::ptrdiff_t(next), ' ');
      goes_on = goes_on && next < text.size();
    }
    visit(std::string_view(text).substr(at, end - at), first);
    at = next;
  }
}

}  // namespace

RawMesh read_obj(const std::filesystem::path& file) {
  std::string text = read_file(file);
  if (text.starts_with("\xEF\xBB\xBF")) text.replace(0, 3, "   ");
  ObjReader reader(file.string());
  visit_lines(std::move(text), [&](std::string_view line, int n) { reader.read(line, n); });
  return reader.mesh();
}

}  // namespace edgescout
