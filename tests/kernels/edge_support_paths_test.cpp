// edge_support on every path (edge_support.h): equal bit for bit.
#include "kernels/error.h"
#include "tests/kernels/edge_support_cases.h"
#include "tests/kernels/paths.h"

namespace edgescout {
namespace {

class EdgeSupportPaths : public test::PathTest {};

void expect_equal(std::span<const EdgeSupport> found, std::span<const EdgeSupport> expected) {
  ASSERT_EQ(found.size(), expected.size());
  for (std::size_t i = 0; i < found.size(); ++i) {
    SCOPED_TRACE("problem " + std::to_string(i));
    EXPECT_EQ(found[i].log_ratio, expected[i].log_ratio);
    EXPECT_EQ(found[i].interior_log_ratio, expected[i].interior_log_ratio);
    EXPECT_EQ(found[i].support, expected[i].support);
    EXPECT_EQ(found[i].best_displaced, expected[i].best_displaced);
  }
}

// 60 problems of up to 3,000 points have more than the path in bands binds at once.
TEST_P(EdgeSupportPaths, EqualsTheReference) {
  std::mt19937 rng = test::test_rng();
  for (const std::uint32_t most : {0u, 1u, 63u, 64u, 65u, 3000u}) {
    SCOPED_TRACE("up to " + std::to_string(most) + " points");
    const test::SupportCase c = test::support_case(rng, 60, most);
    expect_equal(c.run(*tested, c.views(*tested)), c.run(*reference, c.views(*reference)));
  }
}

TEST_P(EdgeSupportPaths, HasNoProblems) {
  std::mt19937 rng = test::test_rng();
  const test::SupportCase c = test::support_case(rng, 0, 0);
  EXPECT_TRUE(c.run(*tested, c.views(*tested)).empty());
}

TEST_P(EdgeSupportPaths, AViewWithoutAnImageSupportsNothing) {
  std::mt19937 rng = test::test_rng();
  const test::SupportCase c = test::support_case(rng, 6, 100);
  std::vector<ViewHandle> views = c.views(*tested), judges = c.views(*reference);
  for (const int without : {0, 1, 2}) {
    const test::Picture& p = c.pictures[std::size_t(without)];
    views[std::size_t(without)] = test::support_view(*tested, p, {});
    judges[std::size_t(without)] = test::support_view(*reference, p, {});
    const std::vector<EdgeSupport> found = c.run(*tested, views);
    expect_equal(found, c.run(*reference, judges));
    EXPECT_EQ(found[std::size_t(without)].log_ratio, 0);
    EXPECT_EQ(found[std::size_t(without)].support, 0);
  }
}

TEST_P(EdgeSupportPaths, BrokenProblemsAreOurBugs) {
  const test::Picture picture{20, 10, std::vector<std::uint8_t>(200, 9)};
  const auto run = [&](const SupportPoint& point, const SupportProblem& problem) {
    const test::SupportCase c{{picture}, std::vector<SupportPoint>(200, point), {problem}};
    for (Backend* backend : {tested.get(), reference.get()}) c.run(*backend, c.views(*backend));
  };
  const SupportPoint good{19, 9, 1000, 31, 23};
  EXPECT_NO_THROW(run(good, {0, 200, 0}));
  EXPECT_THROW(run(good, {1, 200, 0}), LogicError) << "points beyond the list";
  EXPECT_THROW(run(good, {0, 200, 1}), LogicError) << "a view that is not there";
  EXPECT_THROW(run({20, 9, 1000, 31, 23}, {0, 1, 0}), LogicError);
  EXPECT_THROW(run({19, 10, 1000, 31, 23}, {0, 1, 0}), LogicError);
  EXPECT_THROW(run({19, 9, 1000, 32, 23}, {0, 1, 0}), LogicError);
  EXPECT_THROW(run({19, 9, 1000, 31, 24}, {0, 1, 0}), LogicError);
  EXPECT_THROW(run({19, 9, 65535, 31, 23}, {0, 200, 0}), LogicError) << "more than the sums hold";
}

INSTANTIATE_TEST_SUITE_P(Paths, EdgeSupportPaths, test::all_paths, test::param_name);

}  // namespace
}  // namespace edgescout
