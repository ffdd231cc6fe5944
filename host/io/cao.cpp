// Reads ViSP's text CAD format.
//
// The file has V1, then counted sections: points, segments, faces by segments, faces by points and
// (optional) cylinders and circles. `#` starts a comment. `load("file")` includes another file. A
// line may end in name=... and other settings of the tracker, which are ignored.
#include <Eigen/Geometry>
#include <numbers>

#include "host/io/files.h"
#include "host/io/raw_mesh.h"
#include "host/io/text_tokens.h"
#include "kernels/error.h"

namespace edgescout {

using Eigen::Vector3d;

namespace {

constexpr int circle_corners = 64;
// A few bytes make a circle. Without a limit a small file would ask for much memory.
constexpr int max_circles = 4000;
constexpr int max_include_depth = 8;

struct CaoText {
  std::string sections;  // without comments, includes and settings; lines keep their numbers
  std::vector<std::string> includes;
};

CaoText split_text(const std::string& text) {
  CaoText result;
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t end = std::min(text.find('\n', at), text.size());
    std::string line = text.substr(at, end - at);
    at = end + 1;
    line.resize(std::min(line.find('#'), line.size()));
    if (const std::size_t load = line.find("load("); load != std::string::npos) {
      const std::size_t open = line.find('"', load), close = line.find('"', open + 1);
      if (open != std::string::npos && close != std::string::npos)
        result.includes.push_back(line.substr(open + 1, close - open - 1));
      line.resize(load);
    }
    if (const std::size_t setting = line.find('='); setting != std::string::npos)
      line.resize(line.find_last_of(" \t", setting) == std::string::npos
                      ? 0
                      : line.find_last_of(" \t", setting));
    result.sections += line + "\n";
  }
  return result;
}

class CaoReader {
 public:
  CaoReader(const std::string& sections, const std::string& source, RawMesh& mesh)
      : tokens_(sections, source), mesh_(mesh), base_(static_cast<int>(mesh.vertices.size())) {}

  void read() {
    tokens_.expect("V1");
    points_ = tokens_.count("number of points");
    for (int i = 0; i < points_; ++i) {
      Vector3d x;
      for (int axis = 0; axis < 3; ++axis) x[axis] = tokens_.number("point coordinate");
      mesh_.vertices.push_back(x);
    }
    for (int n = tokens_.count("number of segments"); n > 0; --n) {
      const int from = point();
      segments_.push_back({from, point()});
    }
    for (int n = tokens_.count("number of faces by segments"); n > 0; --n) face_by_segments();
    for (int n = tokens_.count("number of faces by points"); n > 0; --n) face_by_points();
    for (int n = optional_count("number of cylinders"); n > 0; --n) cylinder();
    for (int n = optional_count("number of circles"); n > 0; --n) circle();
    if (!tokens_.at_end()) tokens_.fail("the end of the file", tokens_.word("end"));
  }

 private:
  int optional_count(const char* what) { return tokens_.at_end() ? 0 : tokens_.count(what); }

  int index(const char* what, int size) {
    const int i = tokens_.count(what);
    if (i >= size)
      tokens_.fail(std::string(what) + " below " + std::to_string(size), std::to_string(i));
    return i;
  }
  int point() { return base_ + index("point index", points_); }

  void face_by_points() {
    std::vector<int> corners;
    for (int n = tokens_.count("number of corners"); n > 0; --n) corners.push_back(point());
    triangulate(corners, mesh_.vertices, mesh_.triangles);
  }

  // Chains the segments end to end. A segment may have either direction.
  void face_by_segments() {
    std::vector<std::array<int, 2>> sides;
    for (int n = tokens_.count("number of segments of a face"); n > 0; --n)
      sides.push_back(segments_[index("segment index", static_cast<int>(segments_.size()))]);
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
    if (++circles_ > max_circles)
      tokens_.fail("at most " + std::to_string(max_circles) + " circles and ends of cylinders",
                   "another one");
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
    const Vector3d normal = a.cross(b);
    if (!(normal.norm() > 0))
      tokens_.fail("three points that span a plane", "a circle without a plane");
    const std::vector<int> ring = add_ring(x, normal.normalized(), r);
    for (int i = 0; i < circle_corners; ++i)
      mesh_.triangles.push_back({centre, ring[i], ring[(i + 1) % circle_corners]});
  }

  TextTokens tokens_;
  RawMesh& mesh_;
  int base_;
  int points_ = 0, circles_ = 0;
  std::vector<std::array<int, 2>> segments_;
};

void read_into(RawMesh& mesh, const std::filesystem::path& file, int depth) {
  if (depth > max_include_depth)
    throw InputError(file.string(), "load()", "files that include each other", "at most 8 levels");
  const CaoText text = split_text(read_file(file));
  for (const std::string& include : text.includes) {
    try {
      read_into(mesh, file.parent_path() / include, depth + 1);
    } catch (const InputError& error) {
      if (depth > 0) throw;  // the user knows the outermost file alone
      throw InputError(file.string() + ": load(\"" + include + "\"): " + error.what());
    }
  }
  CaoReader(text.sections, file.string(), mesh).read();
}

}  // namespace

RawMesh read_cao(const std::filesystem::path& file) {
  RawMesh mesh;
  read_into(mesh, file, 0);
  return mesh;
}

}  // namespace edgescout
