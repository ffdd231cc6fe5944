// Reads ViSP's text CAD format.
//
// The file has V1 or V2, then counted sections: points, segments, faces by segments, faces by
// points and (optional) cylinders and circles. Each row has a line of its own. What follows its
// numbers is a comment, a setting of the tracker or, of a point of V2, its place in an image; none
// is used.
// `#` starts a comment as well. load("file", t=[x; y; z], tu=[x; y; z]) includes another file,
// turned by the rotation vector tu (rad, or with the suffix deg) and then shifted by t.
#include <Eigen/Geometry>
#include <numbers>

#include "host/core/se3.h"
#include "host/io/files.h"
#include "host/io/raw_mesh.h"
#include "host/io/text_tokens.h"
#include "kernels/error.h"

namespace edgescout {

using Eigen::Vector3d;

namespace {

constexpr int circle_corners = 64;
constexpr int max_include_depth = 8;
constexpr int max_files = 1000, max_rings = 2000;  // of a file with all that it includes

struct CaoInclude {
  std::string file;
  Se3 includer_from_file;
};

struct CaoText {
  std::string sections;  // without comments and includes; lines keep their numbers
  std::vector<CaoInclude> includes;
};

// Reads load("file", t=[..], tu=[..]).
class LoadLine {
 public:
  LoadLine(std::string line, std::string source, int number)
      : line_(std::move(line)), source_(std::move(source)), number_(number) {}

  CaoInclude read() const {
    const std::size_t open = line_.find('"'), close = line_.find('"', open + 1);
    const std::size_t end = line_.rfind(')');
    if (open == std::string::npos || close == std::string::npos || end == std::string::npos ||
        end < close)
      fail("load(\"file\")");
    CaoInclude include{line_.substr(open + 1, close - open - 1), {}};
    std::string rest;
    for (const char c : line_.substr(close + 1, end - close - 1))
      if (c != ' ' && c != '\t') rest += c;
    while (!rest.empty()) {
      const std::size_t bracket = rest.find(']');
      const bool is_shift = rest.starts_with(",t=["), is_turn = rest.starts_with(",tu=[");
      if (bracket == std::string::npos || !(is_shift || is_turn)) fail("t=[x;y;z] or tu=[x;y;z]");
      const std::size_t first = is_shift ? 4 : 5;
      const Vector3d value = numbers(rest.substr(first, bracket - first), is_turn);
      if (is_shift) include.includer_from_file.translation_m = value;
      if (is_turn) include.includer_from_file.rotation = so3_exp(value);
      rest.erase(0, bracket + 1);
    }
    return include;
  }

 private:
  [[noreturn]] void fail(const std::string& expected) const {
    throw InputError(source_, "line " + std::to_string(number_), line_.substr(0, 80), expected);
  }
  Vector3d numbers(std::string list, bool are_angles) const {
    Vector3d values;
    for (int axis = 0; axis < 3; ++axis) {
      const std::size_t end = list.find(';');
      if ((end == std::string::npos) != (axis == 2)) fail("three numbers with ; between");
      std::string word = list.substr(0, end);
      list.erase(0, axis < 2 ? end + 1 : list.size());
      const bool is_deg = are_angles && word.ends_with("deg");
      if (is_deg || (are_angles && word.ends_with("rad"))) word.resize(word.size() - 3);
      values[axis] = TextTokens(word, source_, number_).number("number in load()") *
                     (is_deg ? std::numbers::pi / 180 : 1);
    }
    if (!values.allFinite()) fail("finite numbers");
    return values;
  }

  std::string line_, source_;
  int number_;
};

CaoText split_text(const std::string& text, const std::string& source) {
  CaoText result;
  int number = 1;
  for (std::size_t at = 0; at < text.size(); ++number) {
    const std::size_t end = std::min(text.find_first_of("\r\n", at), text.size());
    std::string line = text.substr(at, end - at);
    at = end + (text.compare(end, 2, "\r\n") == 0 ? 2 : 1);
    line.resize(std::min(line.find('#'), line.size()));
    if (const std::size_t start = line.find_first_not_of(" \t");
        start != std::string::npos && line.compare(start, 5, "load(") == 0) {
      result.includes.push_back(LoadLine(line, source, number).read());
      line.clear();
    }
    result.sections += line + "\n";
  }
  return result;
}

// What a file and all that it includes have used up.
struct CaoTotals {
  int files = 0, rings = 0;
};

class CaoReader {
 public:
  CaoReader(const std::string& sections, const std::string& source, RawMesh& mesh,
            CaoTotals& totals)
      : tokens_(sections, source),
        mesh_(mesh),
        totals_(totals),
        base_(static_cast<int>(mesh.vertices.size())) {}

  void read() {
    const std::string_view version = tokens_.word("V1");
    if (version != "V1" && version != "V2") tokens_.fail("V1 or V2", version);
    tokens_.skip_line();
    points_ = row_count("number of points");
    for (int i = 0; i < points_; ++i) point_row();
    for (int n = row_count("number of segments"); n > 0; --n) {
      const int from = point();
      segments_.push_back({from, point()});
      tokens_.skip_line();
    }
    for (int n = row_count("number of faces by segments"); n > 0; --n) face_by_segments();
    for (int n = row_count("number of faces by points"); n > 0; --n) face_by_points();
    for (int n = optional_count("number of cylinders"); n > 0; --n) cylinder();
    for (int n = optional_count("number of circles"); n > 0; --n) circle();
    if (!tokens_.at_end()) tokens_.fail("the end of the file", tokens_.word("end"));
  }

 private:
  // The first number of a row that has no other.
  int row_count(const char* what) {
    const int count = tokens_.count(what);
    tokens_.skip_line();
    return count;
  }
  int optional_count(const char* what) { return tokens_.at_end() ? 0 : row_count(what); }

  int index(const char* what, int size) {
    const int i = tokens_.count(what);
    if (i >= size)
      tokens_.fail(std::string(what) + " below " + std::to_string(size), std::to_string(i));
    return i;
  }
  int point() { return base_ + index("point index", points_); }

  void point_row() {
    Vector3d& x = mesh_.vertices.emplace_back();
    for (int axis = 0; axis < 3; ++axis) x[axis] = tokens_.number("point coordinate");
    tokens_.skip_line();
  }

  void face_by_points() {
    std::vector<int> corners;
    for (int n = tokens_.count("number of corners"); n > 0; --n) corners.push_back(point());
    tokens_.skip_line();
    triangulate(corners, mesh_.vertices, mesh_.triangles);
  }

  // Chains the segments end to end. A segment may have either direction.
  void face_by_segments() {
    std::vector<std::array<int, 2>> sides;
    for (int n = tokens_.count("number of segments of a face"); n > 0; --n)
      sides.push_back(segments_[index("segment index", static_cast<int>(segments_.size()))]);
    tokens_.skip_line();
    if (sides.size() < 3) return;
    const auto joins = [&](int corner) { return corner == sides[1][0] || corner == sides[1][1]; };
    if (!joins(sides[0][1])) std::swap(sides[0][0], sides[0][1]);
    std::vector<int> corners{sides[0][0]};
    int end = sides[0][0];
    for (const auto& [from, to] : sides) {
      if (from != end && to != end)
        tokens_.fail("segments that follow each other", "a gap in a face by segments");
      end = from == end ? to : from;
      corners.push_back(end);
    }
    if (end != corners.front()) tokens_.fail("a closed face", "a face by segments that is open");
    corners.pop_back();
    triangulate(corners, mesh_.vertices, mesh_.triangles);
  }

  // Both directions of the axis give the same corners, so that the rims of cylinders and circles
  // weld.
  std::vector<int> add_ring(const Vector3d& centre, const Vector3d& axis, double radius) {
    if (++totals_.rings > max_rings)
      tokens_.fail("at most " + std::to_string(max_rings) + " ends of cylinders and circles",
                   "more");
    int least = 0;
    axis.cwiseAbs().minCoeff(&least);
    const Vector3d u = (Vector3d::Unit(least) - axis[least] * axis).normalized(), v = axis.cross(u);
    std::vector<int> ring;
    for (int i = 0; i < circle_corners; ++i) {
      const double angle = 2 * std::numbers::pi * i / circle_corners;
      ring.push_back(static_cast<int>(mesh_.vertices.size()));
      mesh_.vertices.push_back(centre + radius * (std::cos(angle) * u + std::sin(angle) * v));
    }
    return ring;
  }

  double radius() {
    const double r = tokens_.number("radius");
    if (!(r > 0)) tokens_.fail("a radius above 0", std::to_string(r));
    return r;
  }

  // Adds the side walls only. If the cylinder has flat ends, they are circles or faces of the file.
  void cylinder() {
    const Vector3d from = mesh_.vertices[point()], to = mesh_.vertices[point()];
    const double r = radius();
    tokens_.skip_line();
    if (from == to) tokens_.fail("an axis of two points", "a cylinder of no length");
    const Vector3d axis = (to - from).normalized();
    const std::vector<int> low = add_ring(from, axis, r), high = add_ring(to, axis, r);
    for (int i = 0, next = 1; i < circle_corners; ++i, next = (i + 1) % circle_corners) {
      mesh_.triangles.push_back({low[i], low[next], high[next]});
      mesh_.triangles.push_back({low[i], high[next], high[i]});
    }
  }

  // A disc: radius, centre, and two points of its plane.
  void circle() {
    const double r = radius();
    const int centre = point();
    const Vector3d x = mesh_.vertices[centre], a = mesh_.vertices[point()] - x,
                   b = mesh_.vertices[point()] - x;
    tokens_.skip_line();
    const Vector3d normal = a.cross(b);
    if (!(normal.norm() > 0))
      tokens_.fail("three points that span a plane", "a circle without a plane");
    const std::vector<int> ring = add_ring(x, normal.normalized(), r);
    for (int i = 0; i < circle_corners; ++i)
      mesh_.triangles.push_back({centre, ring[i], ring[(i + 1) % circle_corners]});
  }

  TextTokens tokens_;
  RawMesh& mesh_;
  CaoTotals& totals_;
  int base_;
  int points_ = 0;
  std::vector<std::array<int, 2>> segments_;
};

void read_into(RawMesh& mesh, const std::filesystem::path& file, int depth, CaoTotals& totals) {
  if (depth > max_include_depth)
    throw InputError(file.string(), "load()", "files that include each other", "at most 8 levels");
  if (++totals.files > max_files)
    throw InputError(file.string(), "load()", "more files than that",
                     "at most " + std::to_string(max_files));
  const CaoText text = split_text(read_file(file), file.string());
  for (const CaoInclude& include : text.includes) {
    const std::size_t first = mesh.vertices.size();
    try {
      read_into(mesh, file.parent_path() / include.file, depth + 1, totals);
    } catch (const InputError& error) {
      if (depth > 0) throw;  // the user knows the outermost file alone
      throw InputError(file.string() + ": load(\"" + include.file + "\"): " + error.what());
    }
    for (std::size_t i = first; i < mesh.vertices.size(); ++i)
      mesh.vertices[i] = include.includer_from_file * mesh.vertices[i];
  }
  CaoReader(text.sections, file.string(), mesh, totals).read();
}

}  // namespace

RawMesh read_cao(const std::filesystem::path& file) {
  RawMesh mesh;
  CaoTotals totals;
  read_into(mesh, file, 0, totals);
  return mesh;
}

}  // namespace edgescout
