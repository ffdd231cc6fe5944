// template_project on every path: the reference's integers but where float reaches the border
// between two of them (template_project.h).
#include <algorithm>

#include "kernels/error.h"
#include "tests/kernels/template_project_oracle.h"

namespace edgescout {
namespace {

constexpr TemplatePoint untouched{-7, 7, 7};

struct Projection {
  std::vector<TemplatePoint> points;
  std::vector<std::uint32_t> too_near;
};

Projection project_by(Backend& backend, const test::ProjectionCase& c) {
  const ModelPointsHandle points = backend.make_model_points(c.points);
  EXPECT_EQ(points->count, c.points.size());
  Projection out{std::vector<TemplatePoint>(c.places, untouched),
                 std::vector<std::uint32_t>(c.jobs.size(), ~0u)};
  backend.template_project(*points, c.jobs, c.options, out.points, out.too_near);
  return out;
}

bool same(const TemplatePoint& a, const TemplatePoint& b) {
  return a.dx_px == b.dx_px && a.dy_px == b.dy_px && a.bin == b.bin && a.padding == b.padding;
}

// Within `off` of the border between two integers, one more or less is as good.
void expect_rounded_alike(test::Real exact, test::Real off, test::Real found, test::Real expected,
                          test::Real apart) {
  if (apart == 0) return;
  EXPECT_LE(apart, 1 + 2 * off) << "found " << found << ", reference " << expected;
  EXPECT_LE(std::abs(exact - std::floor(exact) - 0.5L), off)
      << "found " << found << ", reference " << expected << " of " << exact;
}

// Returns how many points differ at all.
int expect_agreement(const test::ProjectionCase& c, const Projection& found,
                     const Projection& expected) {
  int different = 0;
  for (std::size_t j = 0; j < c.jobs.size(); ++j) {
    const TemplateProjectJob& job = c.jobs[j];
    std::uint32_t at_the_border = 0;
    for (std::uint32_t i = 0; i < job.point_count; ++i) {
      SCOPED_TRACE("job " + std::to_string(j) + ", point " + std::to_string(i));
      const test::ExactPoint exact =
          test::exact_point(job, c.options, c.points[job.first_point + i]);
      const TemplatePoint &a = found.points[job.first_projected + i],
                          &b = expected.points[job.first_projected + i];
      expect_rounded_alike(exact.dx, exact.off_px, a.dx_px, b.dx_px, std::abs(a.dx_px - b.dx_px));
      expect_rounded_alike(exact.dy, exact.off_px, a.dy_px, b.dy_px, std::abs(a.dy_px - b.dy_px));
      expect_rounded_alike(exact.bin, exact.off_bins, a.bin, b.bin,
                           test::bins_apart(a.bin, b.bin, c.options.bins));
      EXPECT_LT(a.bin, c.options.bins);
      EXPECT_EQ(a.padding, 0);
      at_the_border += std::abs(exact.depth_m - c.options.nearest_m) <= exact.off_m;
      different += !same(a, b);
    }
    EXPECT_LE(std::abs(std::int64_t(found.too_near[j]) - std::int64_t(expected.too_near[j])),
              std::int64_t(at_the_border));
  }
  return different;
}

void expect_gaps_untouched(const test::ProjectionCase& c, const Projection& found) {
  std::vector<char> written(c.places);
  for (const TemplateProjectJob& job : c.jobs)
    std::fill_n(written.begin() + job.first_projected, job.point_count, 1);
  for (std::size_t i = 0; i < c.places; ++i)
    if (!written[i]) {
      EXPECT_TRUE(same(found.points[i], untouched)) << "place " << i;
    }
}

class TemplateProjectPaths : public test::PathTest {};

TEST_P(TemplateProjectPaths, AgreesWithTheReference) {
  std::mt19937 rng = test::test_rng();
  int different = 0, all = 0;
  for (const int bins : {1, 7, 60})
    for (const int most : {1, 5, 63, 64, 65, 256}) {
      SCOPED_TRACE("up to " + std::to_string(most) + " points, " + std::to_string(bins) + " bins");
      const test::ProjectionCase c = test::projection_case(rng, 101, most, most + 30, bins);
      const Projection found = project_by(*tested, c);
      different += expect_agreement(c, found, project_by(*reference, c));
      expect_gaps_untouched(c, found);
      for (const TemplateProjectJob& job : c.jobs) all += int(job.point_count);
    }
  EXPECT_LT(different, all / 500);
}

// More jobs than a device takes workgroups along one dimension, and more points than the narrow
// device binds at once: they go in several batches.
TEST_P(TemplateProjectPaths, ManyJobs) {
  std::mt19937 rng = test::test_rng();
  const test::ProjectionCase c = test::projection_case(rng, 33001, 3, 100, 60);
  ASSERT_GT(c.places * sizeof(TemplatePoint), test::test_band_bytes);
  tested->take_timings();
  const Projection found = project_by(*tested, c);
  if (GetParam() == test::Path::vulkan_bands) {
    const std::vector<StageTime> times = tested->take_timings();
    const auto own = std::ranges::find(times, "template_project", &StageTime::name);
    ASSERT_NE(own, times.end());
    EXPECT_GT(own->calls, 1) << "batches";
  }
  expect_agreement(c, found, project_by(*reference, c));
  expect_gaps_untouched(c, found);
}

TEST_P(TemplateProjectPaths, PointsStayForMoreThanOneCall) {
  std::mt19937 rng = test::test_rng();
  const test::ProjectionCase c = test::projection_case(rng, 20, 60, 200, 60);
  const ModelPointsHandle points = tested->make_model_points(c.points),
                          others = tested->make_model_points(std::span(c.points).first(9));
  std::vector<TemplatePoint> first(c.places), second(c.places);
  std::vector<std::uint32_t> too_near(c.jobs.size());
  tested->template_project(*points, c.jobs, c.options, first, too_near);
  tested->template_project(*points, c.jobs, c.options, second, too_near);
  EXPECT_TRUE(std::ranges::equal(first, second, same));
  EXPECT_EQ(others->count, 9u);
}

TEST_P(TemplateProjectPaths, NothingToProject) {
  std::mt19937 rng = test::test_rng();
  const Pose pose = test::random_pose(rng, 0.3f);
  const test::ProjectionCase empty{{}, {{pose, 0, 0, 0, 0, 0}}, {{260, 250, 35, 45}, 60, 0.01f}};
  EXPECT_EQ(project_by(*tested, empty).too_near, std::vector<std::uint32_t>{0});
  EXPECT_TRUE(project_by(*tested, {{}, {}, empty.options}).too_near.empty());
}

// A point behind the camera or on its plane still has valid numbers, and is counted.
TEST_P(TemplateProjectPaths, PointsTooNearAreCounted) {
  const Pose identity{{1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0}};
  const test::ProjectionCase c{{{0, 0, 0, 1, 0, 0},
                                {0.25f, 0, -1, 0, 1, 0},
                                {0, 0.25f, 0.0625f, 0, 1, 0},
                                {0, 0, 0.125f, 0, 1, 0},
                                {100, -100, 0.125f, 1, 0, 0}},
                               {{identity, 0, 5, 0, 0, 0}, {identity, 3, 2, 5, 0, 0}},
                               {{100, 100, 0, 0}, 4, 0.125f},
                               7};
  const Projection found = project_by(*tested, c);
  EXPECT_EQ(found.too_near, (std::vector<std::uint32_t>{3, 0}));
  const std::vector<TemplatePoint> expected{{0, 0, 0},         {200, 0, 2},        {0, 200, 2},
                                            {0, 0, 2},         {16000, -16000, 0}, {0, 0, 2},
                                            {16000, -16000, 0}};
  EXPECT_TRUE(std::ranges::equal(found.points, expected, same));
}

TEST_P(TemplateProjectPaths, BrokenCallsAreOurBugs) {
  std::mt19937 rng = test::test_rng();
  const test::ProjectionCase good{test::random_points(rng, 3),
                                  {{test::random_pose(rng, 0.3f), 0, 3, 0, 0, 0},
                                   {test::random_pose(rng, 0.3f), 1, 2, 3, 0, 0}},
                                  {{260, 250, 35, 45}, 60, 0.01f},
                                  5};
  const auto throws = [&](const auto& spoil) {
    test::ProjectionCase c = good;
    spoil(c);
    EXPECT_THROW(project_by(*tested, c), LogicError);
    EXPECT_THROW(project_by(*reference, c), LogicError);
  };
  EXPECT_NO_THROW(project_by(*tested, good));
  throws([](auto& c) { c.jobs[1].first_point = 2; });
  throws([](auto& c) { c.jobs[1].first_point = ~0u; });
  throws([](auto& c) { c.jobs[1].first_projected = 2; });  // a place twice
  throws([](auto& c) { c.places = 4; });
  throws([](auto& c) { c.jobs[0].camera_from_object.m[3] = NAN; });
  throws([](auto& c) { c.jobs[0].camera_from_object.m[11] = INFINITY; });
  throws([](auto& c) { c.jobs[0].anchor_y_px = NAN; });
  throws([](auto& c) { c.points[2].tz = NAN; });
  throws([](auto& c) { c.points[0].x_m = 2e4f; });
  throws([](auto& c) { c.options.bins = 0; });
  throws([](auto& c) { c.options.bins = 1 << 16; });
  throws([](auto& c) { c.options.nearest_m = 0; });
  throws([](auto& c) { c.options.nearest_m = NAN; });
  throws([](auto& c) { c.options.intrinsics.fx = 0; });
  throws([](auto& c) { c.options.intrinsics.cy = INFINITY; });
  throws([](auto& c) {  // more points than a template has
    c.points.resize(TEMPLATE_SCORE_MAX_POINTS + 1, c.points[0]);
    c.jobs.assign(1, {c.jobs[0].camera_from_object, 0, TEMPLATE_SCORE_MAX_POINTS + 1, 0, 0, 0});
    c.places = c.points.size();
  });
  const ModelPointsHandle points = tested->make_model_points(good.points);
  std::vector<TemplatePoint> projected(good.places);
  std::vector<std::uint32_t> one(1);
  EXPECT_THROW(tested->template_project(*points, good.jobs, good.options, projected, one),
               LogicError);
}

TEST_P(TemplateProjectPaths, ModelPointsOfAnotherBackendAreOurBugs) {
  if (GetParam() == test::Path::cpu) GTEST_SKIP() << "CPU backends share their points";
  std::mt19937 rng = test::test_rng();
  const ModelPointsHandle foreign = reference->make_model_points(test::random_points(rng, 3));
  EXPECT_THROW(tested->template_project(*foreign, {}, {{260, 250, 35, 45}, 60, 0.01f}, {}, {}),
               LogicError);
}

INSTANTIATE_TEST_SUITE_P(Paths, TemplateProjectPaths, test::all_paths, test::param_name);

}  // namespace
}  // namespace edgescout
