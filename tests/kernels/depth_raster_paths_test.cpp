// depth_raster on every path against the reference (depth_raster.h).
#include <algorithm>
#include <cmath>
#include <limits>

#include "kernels/error.h"
#include "tests/kernels/paths.h"

namespace edgescout {
namespace {

struct Soup {
  std::vector<float> vertices;
  std::vector<std::uint32_t> triangles;
  TriangleMesh mesh() const { return {vertices, triangles}; }
};

// Triangles of random place and size; now and then one reaches behind the camera, or has no area.
Soup random_soup(std::mt19937& rng, int count, float size_m) {
  std::uniform_real_distribution<float> at(-0.05f, 0.05f), offset(-size_m, size_m);
  Soup soup;
  for (int i = 0; i < count; ++i) {
    const float x = at(rng), y = at(rng), z = at(rng);
    for (int k = 0; k < 3; ++k) {
      soup.triangles.push_back(static_cast<std::uint32_t>(soup.vertices.size() / 3));
      const float back = i % 11 == 10 && k == 0 ? -1.0f : 0.0f, spread = i % 13 == 12 ? 0.0f : 1.0f;
      for (float c : {x, y, z + back}) soup.vertices.push_back(c + spread * offset(rng));
    }
  }
  return soup;
}

DepthJob job_at(float angle, float z_m, float focal, float cx, float cy) {
  const float c = std::cos(angle), s = std::sin(angle);
  return {{{c, 0, s, 0.002f, 0, 1, 0, -0.003f, -s, 0, c, z_m}}, {focal, focal * 1.02f, cx, cy}};
}

struct Point {
  double u, v, z;
};
Point project(const DepthJob& job, const float* p) {
  double q[3];
  for (int r = 0; r < 3; ++r) {
    const float* row = job.camera_from_object.m + 4 * r;
    q[r] = double(row[0]) * p[0] + double(row[1]) * p[1] + double(row[2]) * p[2] + row[3];
  }
  return {job.intrinsics.fx * q[0] / q[2] + job.intrinsics.cx,
          job.intrinsics.fy * q[1] / q[2] + job.intrinsics.cy, q[2]};
}

double segment_distance_px(const Point& a, const Point& b, double x, double y) {
  const double dx = b.u - a.u, dy = b.v - a.v, length2 = dx * dx + dy * dy;
  const double t =
      length2 > 0 ? std::clamp(((x - a.u) * dx + (y - a.v) * dy) / length2, 0.0, 1.0) : 0.0;
  return std::hypot(x - a.u - t * dx, y - a.v - t * dy);
}

// Pixels whose centre lies next to an edge of a triangle that is drawn: those may go either way.
std::vector<bool> near_edges(const Soup& soup, const DepthJob& job, int width, int height) {
  std::vector<bool> near(std::size_t(width) * height, false);
  for (std::size_t i = 0; i < soup.triangles.size(); i += 3) {
    Point p[3];
    for (int k = 0; k < 3; ++k)
      p[k] = project(job, soup.vertices.data() + 3 * soup.triangles[i + k]);
    if (std::min({p[0].z, p[1].z, p[2].z}) < DEPTH_NEAR_M) continue;
    for (int y = 0; y < height; ++y)
      for (int x = 0; x < width; ++x)
        for (int k = 0; k < 3; ++k)
          if (segment_distance_px(p[k], p[(k + 1) % 3], x, y) < 1.0 / 64)
            near[std::size_t(y) * width + x] = true;
  }
  return near;
}

struct Case {
  int width, height, triangles;
  float size_m;
};

class DepthRasterPaths : public test::PathTest {};

TEST_P(DepthRasterPaths, AgreesWithTheReference) {
  std::mt19937 rng = test::test_rng();
  for (const Case& c : std::vector<Case>{{1, 1, 5, 0.05f},
                                         {7, 5, 20, 0.03f},
                                         {33, 17, 64, 0.02f},
                                         {61, 47, 300, 0.01f},
                                         {50, 3, 9, 0.1f}}) {
    SCOPED_TRACE(std::to_string(c.width) + "x" + std::to_string(c.height));
    const Soup soup = random_soup(rng, c.triangles, c.size_m);
    std::vector<DepthJob> jobs;
    for (int j = 0; j < 3; ++j)
      jobs.push_back(job_at(0.7f * float(j), 0.3f, float(c.width) * 2, float(c.width) * 0.5f,
                            float(c.height) * 0.45f));
    const std::size_t pixels = std::size_t(c.width) * c.height;
    std::vector<float> found(3 * pixels, -1), expected(3 * pixels, -1);
    tested->depth_raster(soup.mesh(), jobs, c.width, c.height, found);
    reference->depth_raster(soup.mesh(), jobs, c.width, c.height, expected);
    std::size_t compared = 0;
    for (int j = 0; j < 3; ++j) {
      const std::vector<bool> skip = near_edges(soup, jobs[j], c.width, c.height);
      for (std::size_t i = 0; i < pixels; ++i) {
        if (skip[i]) continue;
        ++compared;
        const float a = found[j * pixels + i], b = expected[j * pixels + i];
        if (std::isinf(b))
          EXPECT_EQ(a, b) << "map " << j << ", pixel " << i;
        else
          EXPECT_NEAR(a, b, 1e-5f * b) << "map " << j << ", pixel " << i;
      }
    }
    EXPECT_GE(2 * compared, 3 * pixels);
  }
}

// More maps than one batch holds.
TEST_P(DepthRasterPaths, ManyMaps) {
  std::mt19937 rng = test::test_rng();
  const Soup soup = random_soup(rng, 3, 0.03f);
  std::vector<DepthJob> jobs;
  for (int j = 0; j < 33000; ++j) jobs.push_back(job_at(0.001f * float(j), 0.3f, 8, 2, 2));
  std::vector<float> found(jobs.size() * 20), expected(jobs.size() * 20);
  tested->depth_raster(soup.mesh(), jobs, 5, 4, found);
  reference->depth_raster(soup.mesh(), jobs, 5, 4, expected);
  std::size_t differ = 0, covered = 0;
  for (std::size_t i = 0; i < found.size(); ++i) {
    covered += std::isfinite(expected[i]);
    differ += !(found[i] == expected[i] || std::abs(found[i] - expected[i]) <= 1e-5f * expected[i]);
  }
  EXPECT_GT(covered, found.size() / 50);
  EXPECT_LT(differ, found.size() / 100);  // centres next to an edge
}

// A device takes so many workgroups along one dimension: 65,535 of 64 triangles here.
TEST_P(DepthRasterPaths, MoreTrianglesThanOneDispatchTakes) {
  constexpr std::size_t between = (std::size_t{1} << 22) + 1;
  Soup soup;
  soup.vertices = {-1, -1, 0.5f, 0, -1, 0.5f, -1, 1, 0.5f, 0, -1, 0.4f, 1, -1, 0.4f, 1, 1, 0.4f};
  soup.triangles = {0, 1, 2};
  soup.triangles.resize(3 + 3 * between, 0);  // without area
  soup.triangles.insert(soup.triangles.end(), {3, 4, 5});
  const DepthJob job{{{1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0}}, {3, 3, 5.5f, 5.5f}};
  std::vector<float> found(12 * 12), expected(12 * 12);
  tested->depth_raster(soup.mesh(), {&job, 1}, 12, 12, found);
  reference->depth_raster(soup.mesh(), {&job, 1}, 12, 12, expected);
  EXPECT_EQ(found[12 + 2], 0.5f);
  EXPECT_EQ(found[12 + 9], 0.4f);
  for (std::size_t i = 0; i < found.size(); ++i)
    EXPECT_TRUE(found[i] == expected[i] || std::abs(found[i] - expected[i]) < 1e-5f)
        << "pixel " << i;
}

// lavapipe ends a shader's loops after 65,535 turns in all: large triangles are filled in bands.
TEST_P(DepthRasterPaths, LargeTrianglesFillLargeMaps) {
  Soup wall;
  wall.vertices = {-2, -2, 0.5f, 2, -2, 0.5f, 2, 2, 0.5f, -2, 2, 0.5f};
  wall.triangles = {0, 1, 2, 0, 2, 3};
  constexpr int size = 2048;
  const DepthJob job{{{1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0}},
                     {size, size, size / 2 + 0.3f, size / 2 - 0.1f}};
  std::vector<float> depth(std::size_t(size) * size, -1);
  tested->depth_raster(wall.mesh(), {&job, 1}, size, size, depth);
  std::size_t empty = 0;
  for (const float d : depth) empty += !(std::abs(d - 0.5f) < 1e-5f);
  EXPECT_EQ(empty, 0u);
}

// A hilly square of many triangles under many poses: of the pixels inside its outline none is
// empty, however close to an edge between two triangles it lies.
TEST_P(DepthRasterPaths, EdgesBetweenTrianglesLeaveNoHoles) {
  std::mt19937 rng = test::test_rng();
  std::uniform_real_distribution<float> hill(-0.004f, 0.004f), angle(-0.4f, 0.4f),
      shift(-0.3f, 0.3f);
  constexpr std::uint32_t cells = 24, side = cells + 1;
  Soup hills;
  for (std::uint32_t y = 0; y < side; ++y)
    for (std::uint32_t x = 0; x < side; ++x) {
      const bool inside = x > 0 && y > 0 && x < cells && y < cells;
      for (float c :
           {0.01f * float(x) - 0.12f, 0.01f * float(y) - 0.12f, inside ? hill(rng) : 0.0f})
        hills.vertices.push_back(c);
    }
  for (std::uint32_t y = 0; y < cells; ++y)
    for (std::uint32_t x = 0; x < cells; ++x) {
      const std::uint32_t a = y * side + x, b = a + 1, c = a + side, d = c + 1;
      for (std::uint32_t i : {b, a, d, c, d, a}) hills.triangles.push_back(i);
    }
  constexpr int size = 96;
  std::vector<DepthJob> jobs;
  for (int j = 0; j < 200; ++j)
    jobs.push_back(job_at(angle(rng), 0.4f, 180, 47.5f + shift(rng), 47.5f + shift(rng)));
  std::vector<float> depth(jobs.size() * size * size);
  tested->depth_raster(hills.mesh(), jobs, size, size, depth);
  std::size_t looked_at = 0, empty = 0;
  for (std::size_t j = 0; j < jobs.size(); ++j) {
    Point corner[4];
    for (int k = 0; k < 4; ++k) {
      const std::uint32_t at[] = {0, cells, side * side - 1, cells * side};
      corner[k] = project(jobs[j], hills.vertices.data() + 3 * at[k]);
    }
    for (int y = 0; y < size; ++y)
      for (int x = 0; x < size; ++x) {
        bool inside = true;
        for (int k = 0; k < 4; ++k) {
          const Point &a = corner[k], &b = corner[(k + 1) % 4];
          inside &= (b.u - a.u) * (y - a.v) - (b.v - a.v) * (x - a.u) >
                    std::hypot(b.u - a.u, b.v - a.v) / 16;
        }
        looked_at += inside;
        empty +=
            inside && depth[(j * size + std::size_t(y)) * size + std::size_t(x)] == DEPTH_EMPTY;
      }
  }
  EXPECT_GT(looked_at, 100000u);
  EXPECT_EQ(empty, 0u);
}

TEST_P(DepthRasterPaths, PosesThatAreNoneShowNothing) {
  const Soup triangle{{-1, -1, 0, 1, -1, 0, 0, 1, 0}, {0, 1, 2}};
  for (const float bad :
       {std::numeric_limits<float>::quiet_NaN(), std::numeric_limits<float>::infinity()})
    for (const int word : {0, 3, 10, 11}) {
      DepthJob job = job_at(0, 0.3f, 8, 2, 2);
      job.camera_from_object.m[word] = bad;
      for (Backend* backend : {tested.get(), reference.get()}) {
        std::vector<float> found(20, -1);
        backend->depth_raster(triangle.mesh(), {&job, 1}, 5, 4, found);
        for (const float d : found) EXPECT_EQ(d, DEPTH_EMPTY) << word;
      }
    }
}

TEST_P(DepthRasterPaths, EmptyMeshLeavesEmptyMaps) {
  const DepthJob job = job_at(0, 0.3f, 8, 2, 2);
  std::vector<float> depth(20, -1);
  tested->depth_raster({}, {&job, 1}, 5, 4, depth);
  for (const float d : depth) EXPECT_EQ(d, DEPTH_EMPTY);
  EXPECT_THROW(tested->depth_raster({}, {&job, 1}, 5, 5, depth), LogicError);
}

INSTANTIATE_TEST_SUITE_P(Paths, DepthRasterPaths, test::all_paths, test::param_name);

}  // namespace
}  // namespace edgescout
