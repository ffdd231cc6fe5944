// point_visibility on every path: known scenes by hand, and the reference's flags on random ones
// but where float reaches a border (point_visibility.h).
#include <algorithm>

#include "kernels/error.h"
#include "kernels/point_visibility.h"
#include "tests/kernels/paths.h"
#include "tests/kernels/pose_cases.h"

namespace edgescout {
namespace {

using test::camera_frame;

constexpr std::uint8_t is_seen = POINT_VISIBLE, at_background = POINT_BORDERS_BACKGROUND;

struct Sight {
  std::vector<float> vertices_m;
  std::vector<std::uint32_t> triangles;
  std::vector<float> points_m;
  std::uint32_t shared = 0;
  std::vector<VisibilityJob> jobs;
  int size = 32;
};

// A square of 0.2 m at a depth of 1 m, drawn 16 px wide in a map of 32.
Sight square() {
  Sight sight;
  sight.vertices_m = {-0.1f, -0.1f, 1, 0.1f, -0.1f, 1, 0.1f, 0.1f, 1, -0.1f, 0.1f, 1};
  sight.triangles = {0, 1, 2, 0, 2, 3};
  return sight;
}
constexpr Intrinsics map_of_square{80, 80, 15.5f, 15.5f};

std::vector<std::uint8_t> flags_by(Backend& backend, const Sight& sight) {
  const VisibilityPoints points{sight.points_m, sight.shared};
  std::vector<std::uint8_t> flags(flag_count(points, sight.jobs), 77);
  backend.point_visibility({sight.vertices_m, sight.triangles}, points, sight.jobs, sight.size,
                           flags);
  return flags;
}

class PointVisibilityPaths : public test::PathTest {};

// A shader must not look beyond its map for them.
TEST_P(PointVisibilityPaths, PosesThatAreNoNumbers) {
  Sight sight = square();
  sight.points_m = {0, 0, 0.9f, 0, 0, 1.1f};
  sight.shared = 2;
  Pose no_depth = camera_frame, no_column = camera_frame, far_away = camera_frame;
  no_depth.m[10] = no_column.m[3] = NAN;
  far_away.m[7] = 1e38f;
  for (const Pose& pose : {no_depth, no_column, far_away})
    sight.jobs.push_back({pose, map_of_square, 0.01f, 0, 0});
  const std::uint8_t both = is_seen | at_background;
  EXPECT_EQ(flags_by(*tested, sight), (std::vector<std::uint8_t>{0, 0, both, both, both, both}));
}

TEST_P(PointVisibilityPaths, BeforeBehindAndBesideASquare) {
  Sight sight = square();
  sight.points_m = {0,     0, 0.9f,    // before it
                    0,     0, 1.005f,  // behind it, within the tolerance
                    0,     0, 1.1f,    // behind it
                    0.1f,  0, 1,       // on its border
                    0.15f, 0, 1.1f,    // behind, beside it
                    0.5f,  0, 1,       // outside the map
                    0,     0, -1};     // behind the camera
  sight.shared = 4;
  sight.jobs = {{camera_frame, map_of_square, 0.01f, 4, 3},
                {camera_frame, map_of_square, 0.2f, 0, 0},
                {camera_frame, map_of_square, 0, 2, 1}};
  EXPECT_EQ(flags_by(*tested, sight),
            (std::vector<std::uint8_t>{
                is_seen, is_seen, 0, is_seen | at_background, is_seen | at_background,
                is_seen | at_background, 0,                          // the first job
                is_seen, is_seen, is_seen, is_seen | at_background,  // more tolerance
                is_seen, 0, 0, is_seen | at_background, 0}));        // none
}

TEST_P(PointVisibilityPaths, NothingDrawnHidesNothing) {
  Sight sight = square();
  sight.triangles.clear();
  sight.points_m = {0, 0, 1, 0, 0, -1};
  sight.jobs = {{camera_frame, map_of_square, 0, 0, 2}};
  EXPECT_EQ(flags_by(*tested, sight), (std::vector<std::uint8_t>{is_seen | at_background, 0}));
  sight.jobs.clear();
  EXPECT_TRUE(flags_by(*tested, sight).empty());
}

TEST_P(PointVisibilityPaths, AgreesWithTheReference) {
  std::mt19937 rng = test::test_rng();
  const auto in = [&](float low, float high) {
    return std::uniform_real_distribution<float>(low, high)(rng);
  };
  for (const int size : {3, 32, 77})
    for (const int job_count : {1, 7, 130}) {
      SCOPED_TRACE("maps of " + std::to_string(size) + ", jobs " + std::to_string(job_count));
      Sight sight;
      sight.size = size;
      for (int i = 0; i < 3 * 40; ++i) sight.vertices_m.push_back(in(-0.05f, 0.05f));
      for (std::uint32_t i = 0; i < 60; ++i) sight.triangles.push_back(i % 40);
      for (int i = 0; i < 3 * 500; ++i) sight.points_m.push_back(in(-0.06f, 0.06f));
      sight.shared = 150;
      const float middle = 0.5f * float(size - 1), focal = 2.2f * float(size);
      for (int j = 0; j < job_count; ++j) {
        const auto count = std::uniform_int_distribution<std::uint32_t>(0, 300)(rng);
        sight.jobs.push_back({test::random_pose(rng, 0.3f),
                              {focal, focal, middle, middle},
                              j % 3 == 0 ? 0 : in(0, 0.01f),
                              500 - count,
                              count});
      }
      const std::vector<std::uint8_t> found = flags_by(*tested, sight),
                                      expected = flags_by(*reference, sight);
      std::size_t different = 0, visible = 0;
      for (std::size_t i = 0; i < found.size(); ++i) {
        different += found[i] != expected[i];
        visible += (expected[i] & is_seen) != 0;
      }
      EXPECT_LE(different, found.size() / 200);
      if (size > 3) {
        EXPECT_GT(visible, found.size() / 5);
        EXPECT_LT(visible, found.size());
      }
    }
}

TEST_P(PointVisibilityPaths, BrokenCallsAreOurBugs) {
  const auto throws = [&](const auto& spoil) {
    Sight sight = square();
    sight.points_m = {0, 0, 1, 0, 0, 2};
    sight.jobs = {{camera_frame, map_of_square, 0, 0, 2}};
    spoil(sight);
    EXPECT_THROW(flags_by(*tested, sight), LogicError);
    EXPECT_THROW(flags_by(*reference, sight), LogicError);
  };
  throws([](Sight& s) { s.jobs[0].point_count = 3; });
  throws([](Sight& s) { s.shared = 3; });
  throws([](Sight& s) { s.size = 0; });
  throws([](Sight& s) { s.size = 4097; });
  throws([](Sight& s) { s.triangles[0] = 4; });
  throws([](Sight& s) { s.jobs[0].tolerance_m = -1; });
  throws([](Sight& s) { s.jobs[0].tolerance_m = NAN; });
  const Sight good = square();
  std::vector<std::uint8_t> flags(1);
  EXPECT_THROW(tested->point_visibility({good.vertices_m, good.triangles}, {good.points_m, 0},
                                        good.jobs, good.size, flags),
               LogicError);
}

INSTANTIATE_TEST_SUITE_P(Paths, PointVisibilityPaths, test::all_paths, test::param_name);

}  // namespace
}  // namespace edgescout
