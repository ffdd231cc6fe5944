// shading_sums on every path: a plane by hand, and the reference's sums on bumpy balls.
#include <array>
#include <cmath>
#include <vector>

#include "kernels/cases/synthetic.h"
#include "kernels/error.h"
#include "kernels/shading_sums.h"
#include "tests/kernels/paths.h"
#include "tests/kernels/pictures.h"
#include "tests/kernels/pose_cases.h"

namespace edgescout {
namespace {

using test::camera_frame;

constexpr int width = 70, height = 100;
constexpr Intrinsics camera{200, 210, 34, 48};

class ShadingSumsPaths : public test::PathTest {};

ShadedView view_of(Backend& backend, const test::Picture& picture) {
  return {backend.make_view({}, picture.width, picture.height, picture.view(), camera, {}),
          nullptr};
}

ShadingSums sums_of(Backend& backend, const ShadedView& view, const TriangleMesh& mesh,
                    const ShadingJob& job, float tolerance_m = 0) {
  ShadingSums sums;
  sums.pixels = 77;
  backend.shading_sums({&view, 1}, mesh, {&job, 1}, tolerance_m, {&sums, 1});
  return sums;
}

std::array<double, 9> harmonics(const std::array<double, 3>& n) {
  const auto [x, y, z] = n;
  return {1, x, y, z, x * y, y * z, z * x, x * x - y * y, 3 * z * z - 1};
}

// A large square through (0, 0, 0.5) with the normal (p, q, 1), up to its length.
struct Plane {
  double p = 0.3, q = -0.2;
  std::vector<float> vertices_m;
  std::vector<std::uint32_t> triangles{0, 1, 2, 0, 2, 3};
  Plane() {
    for (const auto& [x, y] : std::vector<std::pair<float, float>>{
             {-0.5f, -0.5f}, {0.5f, -0.5f}, {0.5f, 0.5f}, {-0.5f, 0.5f}})
      vertices_m.insert(vertices_m.end(), {x, y, float(0.5 - p * x - q * y)});
  }
  TriangleMesh mesh() const { return {vertices_m, triangles}; }
};

// What the sums of a plane's normal are over the pixels for which `counts(x, y)` holds, of all that
// a job's map has inside its border.
template <typename Counts>
ShadingSums expected_of(const Plane& plane, const test::Picture& picture, const ShadingJob& job,
                        const Counts& counts) {
  const double length = std::hypot(plane.p, plane.q, 1.0);
  const auto h = harmonics({plane.p / length, plane.q / length, 1 / length});
  ShadingSums sums;
  for (int j = 1; j + 1 < int(SHADING_MAP_PX); ++j)
    for (int i = 1; i + 1 < int(SHADING_MAP_PX); ++i) {
      const int x = job.x_px + i * int(job.stride_px), y = job.y_px + j * int(job.stride_px);
      if (x < 0 || y < 0 || x >= picture.width || y >= picture.height || !counts(x, y)) continue;
      const double grey = picture.pixels[std::size_t(y * picture.width + x)];
      sums.pixels += 1, sums.grey += grey, sums.squares += grey * grey;
    }
  int entry = 0;
  for (std::size_t a = 0; a < 9; ++a) {
    for (std::size_t b = a; b < 9; ++b) sums.system[entry++] = sums.pixels * h[a] * h[b];
    sums.right[a] = sums.grey * h[a];
  }
  return sums;
}

// `share`: of the sums of absolute parts. `pixels`: how many may count on one path alone.
void expect_near(const ShadingSums& found, const ShadingSums& expected, double share,
                 double pixels) {
  constexpr double largest_entry = 4;  // of h h^T
  EXPECT_NEAR(found.pixels, expected.pixels, pixels);
  EXPECT_NEAR(found.grey, expected.grey, 255 * pixels);
  EXPECT_NEAR(found.squares, expected.squares, 255 * 255 * pixels);
  const double each = share * expected.pixels + pixels;
  for (std::size_t e = 0; e < SHADING_SYSTEM; ++e)
    EXPECT_NEAR(found.system[e], expected.system[e], largest_entry * each) << "entry " << e;
  for (std::size_t a = 0; a < SHADING_HARMONICS; ++a)
    EXPECT_NEAR(found.right[a], expected.right[a], 2 * 255 * each) << "harmonic " << a;
}

constexpr double plane_share = 2e-4;

TEST_P(ShadingSumsPaths, APlaneHasOneNormal) {
  std::mt19937 rng = test::test_rng();
  const test::Picture picture = test::random_picture(rng, width, height, false);
  const Plane plane;
  for (Backend* backend : {tested.get(), reference.get()})
    for (const ShadingJob& job :
         {ShadingJob{camera_frame, 5, 3, 1, 0}, ShadingJob{camera_frame, -30, -7, 2, 0},
          ShadingJob{camera_frame, 60, 90, 3, 0}, ShadingJob{camera_frame, 500, 0, 1, 0}}) {
      SCOPED_TRACE(backend->name() + ", map at " + std::to_string(job.x_px));
      expect_near(sums_of(*backend, view_of(*backend, picture), plane.mesh(), job),
                  expected_of(plane, picture, job, [](int, int) { return true; }), plane_share, 0);
    }
}

// A wall before the left half of the image, in a map of half the image's size.
TEST_P(ShadingSumsPaths, KnownSurfacesHideWhatLiesBehind) {
  std::mt19937 rng = test::test_rng();
  const test::Picture picture = test::random_picture(rng, width, height, false);
  const Plane plane;
  constexpr int known_width = 35, known_height = 50, wall_end = 15;
  std::vector<float> wall(std::size_t(known_width * known_height), DEPTH_EMPTY);
  for (int y = 0; y < known_height; ++y)
    for (int x = 0; x < wall_end; ++x) wall[std::size_t(y * known_width + x)] = 0.1f;
  const DepthView known{wall, known_width, known_height, {100, 105, 17.25f, 24.25f}};
  const ShadingJob job{camera_frame, 5, 3, 1, 0};
  for (Backend* backend : {tested.get(), reference.get()}) {
    SCOPED_TRACE(backend->name());
    ShadedView view = view_of(*backend, picture);
    view.known = backend->make_depth(known);
    // Pixel x of the image is x / 2 + 1/4 in the map; at the map's border nothing is hidden.
    const auto is_seen = [&](int x, int y) {
      const int u = (x + 1) / 2, v = (y + 1) / 2;
      return u < 1 || v < 1 || u >= known_width - 1 || v >= known_height - 1 || u > wall_end;
    };
    expect_near(sums_of(*backend, view, plane.mesh(), job, 0.01f),
                expected_of(plane, picture, job, is_seen), plane_share, 0);
    expect_near(sums_of(*backend, view, plane.mesh(), job, 1),
                expected_of(plane, picture, job, [](int, int) { return true; }), plane_share, 0);
  }
}

TEST_P(ShadingSumsPaths, NothingToSumUp) {
  std::mt19937 rng = test::test_rng();
  const test::Picture picture = test::random_picture(rng, width, height, false);
  const Plane plane;
  const ShadingJob job{camera_frame, 5, 3, 1, 0};
  const ShadedView view = view_of(*tested, picture);
  EXPECT_EQ(sums_of(*tested, view, {plane.vertices_m, {}}, job).pixels, 0) << "no triangles";
  const ShadedView blind{tested->make_view({}, width, height, {}, camera, {}), nullptr};
  EXPECT_EQ(sums_of(*tested, blind, plane.mesh(), job).pixels, 0) << "no image";
  ShadingJob lost = job;
  lost.camera_from_object.m[11] = NAN;
  const ShadingSums nowhere = sums_of(*tested, view, plane.mesh(), lost);
  EXPECT_EQ(nowhere.pixels, 0);
  EXPECT_EQ(nowhere.system[0], 0);
  EXPECT_NO_THROW(tested->shading_sums({&view, 1}, plane.mesh(), {}, 0, {}));
}

TEST_P(ShadingSumsPaths, AgreesWithTheReference) {
  std::mt19937 rng = test::test_rng();
  const bench::Mesh ball = bench::bumpy_ball(12, 24);
  const std::vector<test::Picture> pictures{test::random_picture(rng, width, height, false),
                                            test::random_picture(rng, 60, 41, true)};
  std::vector<ShadedView> views, judges;
  // A wall before a part of the second view's image.
  const std::vector<float> wall(20 * 20, 0.38f);
  const DepthView known{wall, 20, 20, {100, 105, 10, 9}};
  for (const auto& [backend, list] :
       {std::pair{tested.get(), &views}, std::pair{reference.get(), &judges}}) {
    for (const test::Picture& picture : pictures) list->push_back(view_of(*backend, picture));
    list->push_back({backend->make_view({}, width, height, {}, camera, {}), nullptr});
    (*list)[1].known = backend->make_depth(known);
  }
  std::vector<ShadingJob> jobs;
  std::uniform_int_distribution<int> place(-60, 30), stride(1, 3), view(0, 2);
  for (int n = 0; n < 70; ++n)
    jobs.push_back({test::random_pose(rng, 0.4f), place(rng), place(rng),
                    std::uint32_t(stride(rng)), std::uint32_t(view(rng))});
  std::vector<ShadingSums> found(jobs.size()), expected(jobs.size());
  tested->shading_sums(views, ball.view(), jobs, 0, found);
  reference->shading_sums(judges, ball.view(), jobs, 0, expected);
  double most = 0, all = 0, different = 0;
  for (std::size_t i = 0; i < jobs.size(); ++i) {
    SCOPED_TRACE("job " + std::to_string(i));
    const double apart = std::abs(found[i].pixels - expected[i].pixels);
    expect_near(found[i], expected[i], 1e-3, 4 + 0.01 * expected[i].pixels);
    if (jobs[i].view == 2) {
      EXPECT_EQ(found[i].pixels, 0) << "no image";
    }
    most = std::max(most, expected[i].pixels), all += expected[i].pixels, different += apart;
  }
  EXPECT_GT(most, 500);
  EXPECT_LT(different, 2e-3 * all);
}

TEST_P(ShadingSumsPaths, BrokenCallsAreOurBugs) {
  std::mt19937 rng = test::test_rng();
  const test::Picture picture = test::random_picture(rng, 33, 17, false);
  const auto throws = [&](const auto& spoil) {
    Plane plane;
    ShadingJob job{camera_frame, 0, 0, 1, 0};
    float tolerance_m = 0;
    spoil(plane, job, tolerance_m);
    for (Backend* backend : {tested.get(), reference.get()})
      EXPECT_THROW(sums_of(*backend, view_of(*backend, picture), plane.mesh(), job, tolerance_m),
                   LogicError);
  };
  throws([](Plane&, ShadingJob& job, float&) { job.view = 1; });
  throws([](Plane&, ShadingJob& job, float&) { job.stride_px = 0; });
  throws([](Plane&, ShadingJob& job, float&) { job.stride_px = 1001; });
  throws([](Plane&, ShadingJob& job, float&) { job.x_px = 1000001; });
  throws([](Plane&, ShadingJob& job, float&) { job.y_px = -1000001; });
  throws([](Plane& plane, ShadingJob&, float&) { plane.triangles[0] = 4; });
  throws([](Plane&, ShadingJob&, float& tolerance_m) { tolerance_m = -1; });
  throws([](Plane&, ShadingJob&, float& tolerance_m) { tolerance_m = NAN; });
  const ShadedView view = view_of(*tested, picture);
  std::vector<ShadingSums> sums(1);
  EXPECT_THROW(tested->shading_sums({&view, 1}, Plane().mesh(), {}, 0, sums), LogicError);
}

INSTANTIATE_TEST_SUITE_P(Paths, ShadingSumsPaths, test::all_paths, test::param_name);

}  // namespace
}  // namespace edgescout
