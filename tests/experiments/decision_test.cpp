// What a decision is timed on: as large as asked for, and the same decision on every path.
#include "host/experiments/decision.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "host/experiments/bin_types.h"
#include "kernels/thread_pool.h"

namespace edgescout::test {
namespace {

TEST(DecisionWork, IsAsLargeAsAskedFor) {
  const auto backend = make_cpu_backend(2);
  ExperimentSettings settings = ExperimentSettings::short_form();
  settings.image_scale = 0.5;
  settings.supersampling = 1;
  const Bin bin = make_bin(bin_types(), settings, 2, backend->threads());
  const DecisionSize size{6, 9, 30, 50};
  const DecisionWork work = make_decision_work(bin, size, *backend);
  EXPECT_EQ(work.views.size(), 7u) << "one more than the candidates: it was taken";
  EXPECT_EQ(std::ranges::count(work.closed, 1), 1);
  EXPECT_EQ(work.candidates.size(), 9u);
  EXPECT_EQ(work.particles.size(), 30u);
  const int view = decide(work, *backend);
  EXPECT_GE(view, 1);
  EXPECT_LT(view, 7);
  EXPECT_EQ(decide(work, *make_backend("cpu-reference")), view);
}

}  // namespace
}  // namespace edgescout::test
