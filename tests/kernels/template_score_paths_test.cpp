// template_score on every path: integer sums, equal bit for bit, and the same anchor on ties
// (template_score.h).
#include <algorithm>

#include "kernels/error.h"
#include "tests/kernels/paths.h"
#include "tests/kernels/template_hits.h"

namespace edgescout {

namespace {

struct Work {
  std::vector<TemplatePoint> points;
  std::vector<TemplateJob> jobs;
};

Work random_work(std::mt19937& rng, const TensorShape& shape, int count, int max_columns,
                 int max_rows) {
  const auto in = [&](int low, int high) {
    return std::uniform_int_distribution<int>(low, high)(rng);
  };
  Work work;
  for (int t = 0; t < count; ++t) {
    const auto points =
        static_cast<std::uint32_t>(t == 0 ? int(TEMPLATE_SCORE_MAX_POINTS) : in(1, 90));
    // Now and then the same points again, or anchors far outside: ties and nothing but outside.
    const bool again = t > 0 && in(0, 3) == 0;
    const int away = in(0, 9) == 0 ? 1000 : 0;
    const TemplateJob last = t > 0 ? work.jobs.back() : TemplateJob{};
    const auto first = static_cast<std::uint32_t>(work.points.size());
    work.jobs.push_back({again ? last.first_point : first, again ? last.point_count : points,
                         in(-9, shape.width) + away, in(-9, shape.height) - away,
                         static_cast<std::uint32_t>(in(1, max_columns)),
                         static_cast<std::uint32_t>(in(1, max_rows))});
    if (again) continue;
    for (std::uint32_t p = 0; p < points; ++p)
      work.points.push_back({static_cast<std::int16_t>(in(-20, 20)),
                             static_cast<std::int16_t>(in(-20, 20)),
                             static_cast<std::uint16_t>(in(0, shape.bins - 1))});
  }
  return work;
}

struct Case {
  int width, height, edges, jobs, max_columns, max_rows, step;
};

class TemplateScorePaths : public test::PathTest {};

TEST_P(TemplateScorePaths, EqualsTheReference) {
  std::mt19937 rng = test::test_rng();
  for (const Case& c : std::vector<Case>{{1, 1, 1, 3, 1, 12, 1},
                                         {7, 5, 3, 20, 1, 12, 1},
                                         {33, 17, 30, 40, 5, 12, 2},
                                         {70, 100, 120, 60, 40, 12, 1},
                                         {70, 100, 20, 60, 7, 12, 3},
                                         {70, 100, 0, 10, 3, 12, 4},
                                         {70, 100, 120, 300, 1, 1, 1},  // one anchor each
                                         {7, 5, 3, 300, 1, 1, 2},
                                         {20, 20, 5, 0, 1, 12, 1}}) {
    SCOPED_TRACE(std::to_string(c.width) + "x" + std::to_string(c.height) + ", " +
                 std::to_string(c.jobs) + " jobs");
    const std::vector<EdgePoint> edges = test::random_edges(rng, c.width, c.height, c.edges);
    const ViewHandle view = tested->make_view(edges, c.width, c.height, {}, {}, {});
    const ViewHandle truth = reference->make_view(edges, c.width, c.height, {}, {}, {});
    const Work work = random_work(rng, view->shape, c.jobs, c.max_columns, c.max_rows);
    std::vector<TemplateHit> hits(work.jobs.size()), expected(work.jobs.size());
    tested->template_score(*view, work.points, work.jobs, c.step, hits);
    reference->template_score(*truth, work.points, work.jobs, c.step, expected);
    EXPECT_EQ(hits, expected);
  }
}

// More jobs than a device takes workgroups along one dimension, so that they are spread over two.
TEST_P(TemplateScorePaths, ManyJobs) {
  std::mt19937 rng = test::test_rng();
  const std::vector<EdgePoint> edges = test::random_edges(rng, 33, 17, 20);
  const ViewHandle view = tested->make_view(edges, 33, 17, {}, {}, {});
  const ViewHandle truth = reference->make_view(edges, 33, 17, {}, {}, {});
  const std::vector<TemplatePoint> points{{0, 0, 3}, {2, -1, 40}};
  std::vector<TemplateJob> jobs;
  for (int j = 0; j < 70001; ++j) jobs.push_back({0, 2, j % 33, j % 17, 1, 1});
  std::vector<TemplateHit> hits(jobs.size()), expected(jobs.size());
  tested->template_score(*view, points, jobs, 1, hits);
  reference->template_score(*truth, points, jobs, 1, expected);
  EXPECT_EQ(hits, expected);
}

// More points than the narrow device binds at once: its jobs go in several batches, each with its
// own points.
TEST_P(TemplateScorePaths, JobsOfManyPoints) {
  std::mt19937 rng = test::test_rng();
  const std::vector<EdgePoint> edges = test::random_edges(rng, 33, 17, 20);
  const ViewHandle view = tested->make_view(edges, 33, 17, {}, {}, {});
  const ViewHandle truth = reference->make_view(edges, 33, 17, {}, {}, {});
  const Work work = random_work(rng, view->shape, 2000, 1, 1);
  ASSERT_GT(work.points.size() * sizeof(TemplatePoint), test::test_band_bytes);
  std::vector<TemplateHit> hits(work.jobs.size()), expected(work.jobs.size());
  tested->take_timings();
  tested->template_score(*view, work.points, work.jobs, 1, hits);
  reference->template_score(*truth, work.points, work.jobs, 1, expected);
  EXPECT_EQ(hits, expected);
  if (GetParam() == test::Path::vulkan_bands) {
    const std::vector<StageTime> times = tested->take_timings();
    const auto whole = std::ranges::find(times, "template_score", &StageTime::name);
    ASSERT_NE(whole, times.end());
    EXPECT_GT(whole->calls, 1) << "batches";
  }
}

// A point just before the camera lands anywhere: it is outside, and costs no memory for the way
// there.
TEST_P(TemplateScorePaths, PointsFarAwayAreOutside) {
  const ViewHandle view = tested->make_view({}, 64, 48, {}, {}, {});
  const std::vector<TemplatePoint> points{
      {-16000, -16000, 3}, {16000, 16000, 5}, {0, 16000, 7}, {-16000, 2, 9}};
  std::vector<TemplateHit> hits(2);
  tested->template_score(*view, points,
                         std::vector<TemplateJob>{{0, 4, 8, 4, 3, 2}, {2, 1, -20000, 30000, 40, 9}},
                         2, hits);
  const std::vector<TemplateHit> expected{{4 * TEMPLATE_SCORE_OUTSIDE, 8, 4},
                                          {TEMPLATE_SCORE_OUTSIDE, -20000, 30000}};
  EXPECT_EQ(hits, expected);
  tested->template_score(*view, points,
                         std::vector<TemplateJob>{{0, 4, 8, 4, 1, 1}, {2, 1, -20000, 30000, 1, 1}},
                         2, hits);
  EXPECT_EQ(hits, expected);
}

TEST_P(TemplateScorePaths, BrokenJobsAreOurBugs) {
  const ViewHandle view = tested->make_view({}, 8, 8, {}, {}, {});
  const std::vector<TemplatePoint> points{{0, 0, 3}, {0, 0, 60}};
  std::vector<TemplateHit> hits(1);
  const auto score = [&](std::size_t count, TemplateJob job) {
    tested->template_score(*view, std::span(points).first(count), {&job, 1}, 1, hits);
  };
  EXPECT_THROW(score(2, {0, 2, 0, 0, 1, 1}), LogicError);  // a bin that is not there
  EXPECT_THROW(score(2, {0, 2, 0, 0, 2, 1}), LogicError);
  EXPECT_THROW(score(1, {0, 2, 0, 0, 1, 1}), LogicError);  // points beyond the list
  EXPECT_THROW(score(1, {0, 0, 0, 0, 1, 1}), LogicError);  // no points
  EXPECT_THROW(score(1, {0, 1, 0, 0, 0, 1}), LogicError);  // no anchors
  const auto most = static_cast<std::uint32_t>(TEMPLATE_SCORE_MAX_ANCHORS);
  EXPECT_THROW(score(1, {0, 1, 0, 0, most + 1, 1}), LogicError);
  EXPECT_THROW(score(1, {0, 1, 0, 0, 1u << 16, 1u << 16}), LogicError);  // 2^32 of them
}

// The best anchor is the last: a shader whose loops end early (lavapipe's, after 65,535 turns)
// misses it.
TEST_P(TemplateScorePaths, TheLargestJobIsLookedThroughToItsEnd) {
  const std::vector<EdgePoint> corner{{95, 95, 0, 10}};
  const ViewHandle view = tested->make_view(corner, 96, 96, {}, {}, {});
  const std::vector<TemplatePoint> points(TEMPLATE_SCORE_MAX_POINTS, {0, 0, 0});
  const std::vector<TemplateJob> jobs{{0, TEMPLATE_SCORE_MAX_POINTS, -32, 32, 128, 64}};
  ASSERT_EQ(jobs[0].columns * jobs[0].rows, std::uint32_t(TEMPLATE_SCORE_MAX_ANCHORS));
  std::vector<TemplateHit> hits(1);
  tested->template_score(*view, points, jobs, 1, hits);
  EXPECT_EQ(hits[0].x, 95);
  EXPECT_EQ(hits[0].y, 95);
}

INSTANTIATE_TEST_SUITE_P(Paths, TemplateScorePaths, test::all_paths, test::param_name);

}  // namespace
}  // namespace edgescout
