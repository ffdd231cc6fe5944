#include "kernels/depth_raster.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <random>

#include "kernels/error.h"
#include "kernels/thread_pool.h"

namespace edgescout {
namespace {

using Vec3 = std::array<double, 3>;

Vec3 minus(const Vec3& a, const Vec3& b) { return {a[0] - b[0], a[1] - b[1], a[2] - b[2]}; }
double dot(const Vec3& a, const Vec3& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }
Vec3 cross(const Vec3& a, const Vec3& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

struct Soup {
  std::vector<float> vertices;
  std::vector<std::uint32_t> triangles;
  TriangleMesh mesh() const { return {vertices, triangles}; }
};

Soup random_soup(std::mt19937& rng, int count, float size_m) {
  std::uniform_real_distribution<float> at(-0.05f, 0.05f), offset(-size_m, size_m);
  Soup soup;
  for (int i = 0; i < count; ++i) {
    const float x = at(rng), y = at(rng), z = at(rng);
    for (int k = 0; k < 3; ++k) {
      soup.triangles.push_back(static_cast<std::uint32_t>(soup.vertices.size() / 3));
      for (float c : {x, y, z}) soup.vertices.push_back(c + offset(rng));
    }
  }
  return soup;
}

DepthJob job_at(float angle, float z_m, float focal, float cx, float cy) {
  const float c = std::cos(angle), s = std::sin(angle);
  return {{{c, 0, s, 0.002f, 0, 1, 0, -0.003f, -s, 0, c, z_m}}, {focal, focal * 1.02f, cx, cy}};
}

std::vector<Vec3> corners_in_camera(const Soup& soup, const DepthJob& job, std::size_t triangle) {
  std::vector<Vec3> corners;
  const float* m = job.camera_from_object.m;
  for (int k = 0; k < 3; ++k) {
    const float* p = soup.vertices.data() + 3 * soup.triangles[3 * triangle + k];
    Vec3 q{};
    for (int r = 0; r < 3; ++r)
      q[r] = double(m[4 * r]) * p[0] + double(m[4 * r + 1]) * p[1] + double(m[4 * r + 2]) * p[2] +
             m[4 * r + 3];
    corners.push_back(q);
  }
  return corners;
}

// Moeller and Trumbore: z where the ray (dx, dy, 1) meets the triangle, or infinity.
double ray_depth(const std::vector<Vec3>& t, const Vec3& ray) {
  const Vec3 e1 = minus(t[1], t[0]), e2 = minus(t[2], t[0]), p = cross(ray, e2);
  const double det = dot(e1, p);
  if (det == 0) return DEPTH_EMPTY;
  const Vec3 s = {-t[0][0], -t[0][1], -t[0][2]}, q = cross(s, e1);
  const double u = dot(s, p) / det, v = dot(ray, q) / det;
  return u >= 0 && v >= 0 && u + v <= 1 ? dot(e2, q) / det : double(DEPTH_EMPTY);
}

double segment_distance_px(const Vec3& a, const Vec3& b, const Intrinsics& k, int x, int y) {
  const double ax = k.fx * a[0] / a[2] + k.cx, ay = k.fy * a[1] / a[2] + k.cy;
  const double dx = k.fx * b[0] / b[2] + k.cx - ax, dy = k.fy * b[1] / b[2] + k.cy - ay;
  const double t = std::clamp(((x - ax) * dx + (y - ay) * dy) / (dx * dx + dy * dy), 0.0, 1.0);
  return std::hypot(x - ax - t * dx, y - ay - t * dy);
}

// Compares a map with rays; pixels next to an edge may go either way and are left out, counted by
// the caller.
int expect_rays(const Soup& soup, const DepthJob& job, int width, int height, const float* depth) {
  int compared = 0;
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) {
      const Vec3 ray = {(x - double(job.intrinsics.cx)) / job.intrinsics.fx,
                        (y - double(job.intrinsics.cy)) / job.intrinsics.fy, 1};
      double nearest = DEPTH_EMPTY, edge_px = 1e9;
      for (std::size_t i = 0; i < soup.triangles.size() / 3; ++i) {
        const auto t = corners_in_camera(soup, job, i);
        if (t[0][2] < DEPTH_NEAR_M || t[1][2] < DEPTH_NEAR_M || t[2][2] < DEPTH_NEAR_M) continue;
        nearest = std::min(nearest, ray_depth(t, ray));
        for (int k = 0; k < 3; ++k)
          edge_px =
              std::min(edge_px, segment_distance_px(t[k], t[(k + 1) % 3], job.intrinsics, x, y));
      }
      if (edge_px < 1.0 / 64) continue;
      ++compared;
      const float found = depth[y * width + x];
      if (std::isinf(nearest))
        EXPECT_EQ(found, DEPTH_EMPTY) << x << " " << y;
      else
        EXPECT_NEAR(found, nearest, 1e-5 * nearest) << x << " " << y;
    }
  return compared;
}

struct Case {
  int width, height, triangles;
  float size_m;
};

void PrintTo(const Case& c, std::ostream* out) {
  *out << c.width << "x" << c.height << ", " << c.triangles << " triangles of " << c.size_m << " m";
}

class DepthRaster : public testing::TestWithParam<Case> {};

TEST_P(DepthRaster, MeetsRaysAtEveryPixel) {
  const Case c = GetParam();
  std::mt19937 rng(7u + c.width);
  const Soup soup = random_soup(rng, c.triangles, c.size_m);
  std::vector<DepthJob> jobs;
  for (int j = 0; j < 3; ++j)
    jobs.push_back(job_at(0.7f * j, 0.3f, c.width * 2.0f, c.width * 0.5f, c.height * 0.45f));
  const std::size_t pixels = std::size_t(c.width) * c.height;
  std::vector<float> reference(3 * pixels, -1), fast(3 * pixels, -1), one(pixels, -1);
  ThreadPool pool(2);
  depth_raster_reference(soup.mesh(), jobs, c.width, c.height, reference);
  depth_raster_fast(soup.mesh(), jobs, c.width, c.height, fast, pool);
  depth_raster_fast(soup.mesh(), std::span(jobs).subspan(1, 1), c.width, c.height, one, pool);
  int compared = 0;
  for (int j = 0; j < 3; ++j) {
    compared += expect_rays(soup, jobs[j], c.width, c.height, reference.data() + j * pixels);
    expect_rays(soup, jobs[j], c.width, c.height, fast.data() + j * pixels);
  }
  EXPECT_GE(compared, 2 * static_cast<int>(pixels));
  EXPECT_TRUE(std::equal(one.begin(), one.end(), fast.begin() + pixels)) << "bands change nothing";
}

INSTANTIATE_TEST_SUITE_P(Sizes, DepthRaster,
                         testing::Values(Case{1, 1, 5, 0.05f}, Case{7, 5, 20, 0.03f},
                                         Case{33, 17, 40, 0.02f}, Case{61, 47, 200, 0.01f},
                                         Case{50, 3, 9, 1.5f}));

TEST(DepthRasterRules, BothWindingsAndSharedEdgesAreCovered) {
  // A square of two triangles with opposite windings whose border runs through pixel centres: no
  // hole on the diagonal, borders included.
  Soup soup{{0, 0, 1, 4, 0, 1, 4, 4, 1, 0, 4, 1}, {0, 1, 2, 0, 3, 2}};
  const DepthJob job{{{1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0}}, {1, 1, 1, 1}};
  std::vector<float> reference(49), fast(49);
  ThreadPool pool(2);
  depth_raster_reference(soup.mesh(), {&job, 1}, 7, 7, reference);
  depth_raster_fast(soup.mesh(), {&job, 1}, 7, 7, fast, pool);
  for (int y = 0; y < 7; ++y)
    for (int x = 0; x < 7; ++x) {
      const float expected = x >= 1 && x <= 5 && y >= 1 && y <= 5 ? 1.0f : DEPTH_EMPTY;
      EXPECT_EQ(reference[y * 7 + x], expected) << x << " " << y;
      EXPECT_EQ(fast[y * 7 + x], expected) << x << " " << y;
    }
}

TEST(DepthRasterRules, TrianglesBehindOrTooNearOrEdgeOnAreDropped) {
  Soup soup{{-1, -1, -1,      1, -1, -1, 0, 1, -1,  // behind
             -1, -1, 0.0005f, 1, -1, 2,  0, 1, 2,   // one corner too near
             0,  0,  1,       0, 0,  2,  0, 0, 3},  // a point in the image
            {0, 1, 2, 3, 4, 5, 6, 7, 8}};
  const DepthJob job{{{1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0}}, {4, 4, 4, 4}};
  std::vector<float> depth(81, 0.0f);
  ThreadPool pool(2);
  depth_raster_reference(soup.mesh(), {&job, 1}, 9, 9, depth);
  EXPECT_TRUE(std::ranges::all_of(depth, [](float z) { return z == DEPTH_EMPTY; }));
  depth.assign(81, 0.0f);
  depth_raster_fast(soup.mesh(), {&job, 1}, 9, 9, depth, pool);
  EXPECT_TRUE(std::ranges::all_of(depth, [](float z) { return z == DEPTH_EMPTY; }));
}

TEST(DepthRasterRules, WrongSizesAndIndicesAreOurBugs) {
  Soup soup{{0, 0, 1, 4, 0, 1, 4, 4, 1}, {0, 1, 3}};
  const DepthJob job{{{1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0}}, {1, 1, 1, 1}};
  std::vector<float> depth(49), small(48);
  ThreadPool pool(2);
  EXPECT_THROW(depth_raster_reference(soup.mesh(), {&job, 1}, 7, 7, depth), LogicError);
  EXPECT_THROW(depth_raster_fast(soup.mesh(), {&job, 1}, 7, 7, depth, pool), LogicError);
  soup.triangles[2] = 2;
  EXPECT_THROW(depth_raster_reference(soup.mesh(), {&job, 1}, 7, 7, small), LogicError);
  EXPECT_THROW(depth_raster_fast(soup.mesh(), {&job, 1}, 7, 7, small, pool), LogicError);
}

}  // namespace
}  // namespace edgescout
