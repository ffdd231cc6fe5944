#include "host/experiments/rates.h"

#include <gtest/gtest.h>

#include "host/experiments/trials.h"

namespace edgescout::test {
namespace {

// image, distance_rad, method, right, mspd_px, ms
std::vector<std::string> row(const std::string& image, const std::string& distance_rad,
                             const std::string& method, const std::string& right,
                             const std::string& mspd_px = "1", const std::string& ms = "2") {
  return {"set", image,  "part", "part_0", "0",   distance_rad, "1", method,
          "1",   "0.01", "1",    mspd_px,  right, "12",         "0", ms};
}

Table trials() {
  return {{},
          trial_columns(),
          {row("a", "0.1", "one", "1"), row("a", "0.02", "one", "1"),
           row("b", "0.07", "one", "0", "50"), row("b", "0.4", "one", "0", "9.9"),
           row("a", "0.1", "two", "0", "3", ""), row("b", "0.4", "two", "1", "3", "")}};
}

Series series(const std::string& method) {
  return {method, [method](const Table& table, std::size_t r) {
            return text_in(table, r, "method") == method;
          }};
}

TEST(Levels, EndWhereTheRecordedStartsLie) {
  EXPECT_EQ(level_of(0.001), 1);
  EXPECT_EQ(level_of(0.1), 1);
  EXPECT_EQ(level_of(0.1001), 2);
  EXPECT_EQ(level_of(0.3), 3);
  EXPECT_EQ(level_of(0.4), 4);
}

TEST(Rates, CountStartsByLevelAndImage) {
  const LevelRates rates = rates_of(trials(), series("one"), pose_criterion());
  ASSERT_EQ(rates.clusters[0].size(), 2u);  // images a and b
  EXPECT_EQ(rates.clusters[0][0].hits, 2);
  EXPECT_EQ(rates.clusters[0][0].trials, 2);
  EXPECT_EQ(rates.clusters[0][1].hits, 0);
  EXPECT_EQ(rates.clusters[0][1].trials, 1);
  EXPECT_TRUE(rates.clusters[1].empty());
  ASSERT_EQ(rates.clusters[3].size(), 1u);
  EXPECT_EQ(rates.clusters[3][0].hits, 0);
  EXPECT_EQ(rates.ms, (std::vector<double>{2, 2, 2, 2}));
  EXPECT_EQ(rates_of(trials(), series("one"), image_criterion()).clusters[3][0].hits, 1);
}

TEST(Rates, AreATableWithARowAMethod) {
  const std::string text = rate_table(trials(), {series("one"), series("two")}, pose_criterion());
  // Of two images with 2 of 2 and 0 of 1 a bootstrap draws 0 % and 100 %; of one image Wilson's
  // interval stands, 0 of 1.
  EXPECT_NE(text.find("| one | 66.7 % [0, 100] |  |  | 0 % [0, 79] | 50 % [0, 100] | 4 | 2.0 |\n"),
            std::string::npos)
      << text;
  EXPECT_NE(text.find("| two | 0 % [0, 79] |  |  | 100 % [21, 100] | 50 % [0, 100] | 2 |  |\n"),
            std::string::npos)
      << text;
}

TEST(Rates, HaveNoTimesWhereSeveralProgramsTookThem) {
  Table table = trials();
  table.notes = {{"commit", "0123456789ab"}};
  EXPECT_EQ(rates_of(table, series("one"), pose_criterion()).ms.size(), 4u);
  table.notes = {{"commit", "0123456789ab fedcba987654"}};
  EXPECT_TRUE(rates_of(table, series("one"), pose_criterion()).ms.empty());
}

// As many images as the bootstrap draws from, and a word where it has too few.
TEST(Rates, SayHowManyImagesTheIntervalsAreOver) {
  EXPECT_NE(rate_table(trials(), {series("one")}, pose_criterion())
                .find("bootstrap over 2 images, so few that the true ones are wider.\n"),
            std::string::npos);
  Table table{{}, trial_columns(), {}};
  for (const char* image : {"a", "b", "c", "d", "e", "f", "g", "h", "i", "j"})
    table.rows.push_back(row(image, "0.1", "one", "1"));
  EXPECT_NE(
      rate_table(table, {series("one")}, pose_criterion()).find("bootstrap over 10 images.\n"),
      std::string::npos);
}

// Of two images in one of which the first method is right and the other wrong, the draws'
// differences are 0, a half and 1; where the methods ran from different starts there is nothing to
// compare.
TEST(Rates, AreComparedOverTheSameDraws) {
  Table table{
      {},
      trial_columns(),
      {row("a", "0.1", "one", "1"), row("b", "0.1", "one", "1"), row("a", "0.1", "two", "0"),
       row("b", "0.1", "two", "1"), row("a", "0.3", "one", "1")}};
  const std::string text = rate_table(table, {series("one"), series("two")}, pose_criterion(),
                                      {{"one", "two"}, {"one", "three"}});
  EXPECT_NE(text.find("| one less two | +50.0 [+0.0, +100.0] |  |  |  |  | | |\n"),
            std::string::npos)
      << text;
  EXPECT_EQ(text.find("three"), std::string::npos) << "a method that never ran";
}

TEST(Rates, ArePlottedInTheMiddleOfTheirBins) {
  Table drawn = trials();
  drawn.rows.push_back(row("a", "0.26", "one", "1"));
  const Panel panel = rate_panel("title", drawn, {series("one"), series("none")}, pose_criterion());
  ASSERT_EQ(panel.lines.size(), 1u) << "a method that never ran has no line";
  std::vector<std::pair<double, double>> points;
  for (const PlotPoint& point : panel.lines[0].points) points.emplace_back(point.x, point.y);
  ASSERT_EQ(points.size(), 4u);  // (0, 0.05], (0.05, 0.1], (0.25, 0.3], (0.35, 0.4]
  const double x[] = {0.025, 0.075, 0.275, 0.375}, y[] = {1, 0.5, 1, 0};
  for (int i = 0; i < 4; ++i) {
    EXPECT_NEAR(points[i].first, x[i], 1e-12);
    EXPECT_EQ(points[i].second, y[i]);
  }
}

// Starts at four distances alone, as recorded ones, are drawn where they lie.
TEST(Rates, OfRecordedStartsArePlottedAtTheirDistance) {
  Table recorded{{}, trial_columns(), {row("a", "0.1", "one", "1"), row("a", "0.2", "one", "0")}};
  const Panel panel = rate_panel("title", recorded, {series("one")}, pose_criterion());
  EXPECT_NEAR(panel.lines.at(0).points.at(0).x, 0.1, 1e-12);
  EXPECT_NEAR(panel.lines.at(0).points.at(1).x, 0.2, 1e-12);
}

TEST(Criteria, SayWhatCounts) {
  EXPECT_EQ(pose_criterion().text, "below 0.1 rad and 5 mm");
  EXPECT_EQ(image_criterion().text, "MSPD < 10 px");
}

TEST(Percent, KeepsATenthWhereThereIsOne) {
  EXPECT_EQ(percent(0.5), "50 %");
  EXPECT_EQ(percent(2.0 / 3), "66.7 %");
  EXPECT_EQ(percent(1), "100 %");
  EXPECT_EQ(percent(0.25, {0.104, 0.396}), "25 % [10, 40]");
}

TEST(Median, IsTheMiddle) {
  EXPECT_EQ(median({3, 1, 2}), 2);
  EXPECT_EQ(median({4, 1, 2, 3}), 2.5);
  EXPECT_EQ(median({}), 0);
  EXPECT_EQ(mean({1, 2, 6}), 3);
}

}  // namespace
}  // namespace edgescout::test
