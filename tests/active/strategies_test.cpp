// The strategies that use no combinations.
#include <gtest/gtest.h>

#include "tests/active/plan.h"
#include "tests/io/expect_input_error.h"

namespace edgescout::test {
namespace {

TEST(Disocclusion, SumsNewPointsByPsi) {
  Plan t;
  t.options.strategy = Strategy::Disocclusion;
  const std::vector<ViewInformation> views = t.information();
  for (std::size_t v = 1; v < views.size(); ++v) {
    double expected = 0;
    for (const Detection& c : t.candidates) {
      const TemplateTable& table = t.tables[c.object];
      std::vector<char> seen(table.total, 0);
      for (const TemplateTablePoint& p : table.visible_from(t.views[0] * c.world_from_object))
        seen[p.id] = 1;  // all project into the image
      for (const TemplateTablePoint& p : table.visible_from(t.views[v] * c.world_from_object))
        expected += seen[p.id] ? 0 : c.psi;
    }
    EXPECT_NEAR(views[v].information, expected, 1e-6);
  }
}

TEST(Random, DrawsEveryOpenViewAlike) {
  Plan t(1);
  t.options.strategy = Strategy::Random;
  t.closed[5] = 1;
  std::vector<int> chosen(t.views.size(), 0);
  for (std::uint64_t seed = 0; seed < 2000; ++seed) {
    t.options.seed = seed;
    ++chosen[*best_view(t.information())];
  }
  EXPECT_EQ(chosen[0] + chosen[5], 0);
  for (std::size_t v = 1; v < chosen.size(); ++v) EXPECT_NEAR(chosen[v], v == 5 ? 0 : 250, 75);
  const std::optional<int> first = best_view(t.information());
  EXPECT_EQ(first, best_view(t.information()));
}

TEST(Fixed, FollowsItsSequence) {
  Plan t(1);
  t.options.strategy = Strategy::Fixed;
  EXPECT_EQ(best_view(t.information()), 1);
  t.options.sequence = {0, 7, 3};
  EXPECT_EQ(best_view(t.information()), 7);
  t.closed[7] = 1;
  EXPECT_EQ(best_view(t.information()), 3);
  t.closed[3] = 1;
  EXPECT_EQ(best_view(t.information()), 1);
}

TEST(Strategies, HaveNames) {
  for (const Strategy s :
       {Strategy::Information, Strategy::Disocclusion, Strategy::Random, Strategy::Fixed})
    EXPECT_EQ(strategy_from(to_string(s)), s);
  expect_input_error([] { strategy_from("best"); }, {"next_view.strategy", "best", "mi-max"});
  NextViewOptions options;
  options.cap_px = 100;
  expect_input_error([&] { options.validate(); }, {"next_view.chamfer_cap"});
  options = {};
  options.reduction = 0.5;
  expect_input_error([&] { options.validate(); }, {"next_view.map_reduction"});
  options = {};
  options.sigma_px = 0.2;  // sharper than float tells apart at this cap
  expect_input_error([&] { options.validate(); }, {"next_view.sigma"});
}

}  // namespace
}  // namespace edgescout::test
