// The report of the experiment. The bins have tests of their own.
#include "host/experiments/nbv.h"

#include <gtest/gtest.h>

#include <tuple>
#include <utility>

namespace edgescout::test {
namespace {

// The columns that the report reads.
Table no_rows() {
  return {{},
          {"bin", "types", "search", "strategy", "draw", "views", "group", "instances", "correct",
           "wrong", "shown", "seconds", "correct_px", "wrong_px"},
          {}};
}

// Judged in the image, with a table of their own, and no part of "all bins".
TEST(NbvReport, KeepsPhotographsApart) {
  Table table = no_rows();
  for (const char* types : {"own", "cad", PHOTOGRAPHED_BINS})
    table.rows.push_back(
        {"0", types, "one", "mi-max", "0", "1", "light", "4", "1", "2", "4", "", "3", "0"});
  table.rows.push_back(
      {"0", "own", "one", "mi-max", "0", "2", "light", "4", "1", "2", "4", "", "3", "0"});
  const Report report = nbv_report({}, table);
  const std::string& text = report.markdown;
  EXPECT_EQ(report.panels.back().lines.at(0).points.size(), 1u) << "no view that there was not";
  EXPECT_EQ(text.find("| 2 views |", text.find("## photographs")), std::string::npos) << text;
  EXPECT_NE(text.find("Bins: 1 (numbers 0) and 1 of CAD parts (numbers 0)."), std::string::npos)
      << text;
  EXPECT_NE(text.find("one pile, 1 of its views in turn the first"), std::string::npos) << text;
  EXPECT_NE(text.find("## all bins, one type, lightly occluded\n\n8 instances."), std::string::npos)
      << text;
  const std::size_t photographs =
      text.find("## photographs, one type, lightly occluded\n\n4 instances.");
  ASSERT_NE(photographs, std::string::npos) << text;
  EXPECT_NE(text.find("| MI-MAX | 75 %", photographs), std::string::npos) << text;
  EXPECT_NE(text.find("| MI-MAX | 0.00 |", photographs), std::string::npos) << text;
  EXPECT_EQ(text.find("Shown by some image so far |", photographs), std::string::npos) << text;
}

// Nobody is clairvoyant where nobody knows what shows; that is no result of none.
TEST(NbvReport, HasOfEverySetTheStrategiesThatRanThere) {
  Table table = no_rows();
  for (const auto& [types, strategy] :
       {std::pair{"own", "clairvoyant"}, {"own", "mi-max"}, {PHOTOGRAPHED_BINS, "mi-max"}})
    table.rows.push_back(
        {"0", types, "one", strategy, "0", "1", "light", "4", "1", "2", "4", "", "3", "0"});
  const Report report = nbv_report({}, table);
  const std::size_t photographs = report.markdown.find("## photographs");
  EXPECT_LT(report.markdown.find("| Clairvoyant |"), photographs) << report.markdown;
  EXPECT_EQ(report.markdown.find("Clairvoyant", photographs), std::string::npos) << report.markdown;
  EXPECT_NE(report.markdown.find("4 instances.", photographs), std::string::npos)
      << report.markdown;
  EXPECT_EQ(report.panels.back().lines.size(), 1u);
}

// Times of cells that several programs made are no one's.
TEST(NbvReport, HasNoTimesOfSeveralCommits) {
  Table table = no_rows();
  table.rows.push_back(
      {"0", "own", "one", "mi-max", "0", "2", "light", "4", "1", "2", "4", "1.5", "3", "0"});
  table.notes = {{"commit", "abc"}};
  EXPECT_NE(nbv_report({}, table).markdown.find("Seconds of a step"), std::string::npos);
  table.notes = {{"commit", "abc def"}};
  EXPECT_EQ(nbv_report({}, table).markdown.find("Seconds of a step"), std::string::npos);
}

// Of both sets of parts each by itself, then of all bins, though those of both have the same
// numbers.
TEST(NbvReport, KeepsCadPartsApartAndAddsThemUp) {
  Table table = no_rows();
  for (const auto& [bin, types, correct] :
       {std::tuple{"0", "own", "4"}, {"1", "own", "2"}, {"0", "cad", "1"}, {"1", "cad", "0"}})
    for (const char* group : {"light", "heavy"})
      table.rows.push_back(
          {bin, types, "all", "mi-max", "0", "1", group, "4", correct, "0", "4", "", "0", "0"});
  const Report report = nbv_report({}, table);
  EXPECT_NE(report.markdown.find("Bins: 2 (numbers 0 to 1) and 2 of CAD parts (numbers 0 to 1)."),
            std::string::npos)
      << report.markdown;
  EXPECT_NE(report.markdown.find("## three types, highly occluded\n\n8 instances."),
            std::string::npos);
  EXPECT_NE(report.markdown.find("| MI-MAX | 75 %"), std::string::npos) << report.markdown;
  EXPECT_NE(report.markdown.find("## CAD parts, three types, highly occluded\n\n8 instances."),
            std::string::npos);
  EXPECT_NE(report.markdown.find("| MI-MAX | 12.5 %"), std::string::npos) << report.markdown;
  EXPECT_NE(report.markdown.find("## all bins, three types, highly occluded\n\n16 instances."),
            std::string::npos);
  EXPECT_NE(report.markdown.find("| MI-MAX | 43.8 %"), std::string::npos) << report.markdown;
  ASSERT_EQ(report.panels.size(), 12u);
  EXPECT_DOUBLE_EQ(report.panels[8].lines[0].points[0].y, 7.0 / 16);
  EXPECT_EQ(report.columns, 2) << "a row a set and measure";
  EXPECT_EQ(report.panels[4].title, "CAD parts, three types, lightly occluded");
  EXPECT_DOUBLE_EQ(report.panels[4].lines[0].points[0].y, 0.125);
}

// Bins of one number are one cluster among all bins. Two pairs that agree have Wilson's interval of
// two trials, although one bin of each kind of parts fails.
TEST(NbvReport, ResamplesBinsOfOneNumberAsOne) {
  Table table = no_rows();
  for (const auto& [bin, types, correct] :
       {std::tuple{"0", "own", "4"}, {"1", "own", "0"}, {"0", "cad", "0"}, {"1", "cad", "4"}})
    table.rows.push_back(
        {bin, types, "all", "mi-max", "0", "1", "light", "4", correct, "0", "4", "", "0", "0"});
  const std::string text = nbv_report({}, table).markdown;
  const std::size_t all = text.find("## all bins, three types, lightly occluded\n\n16 instances.");
  ASSERT_NE(all, std::string::npos) << text;
  EXPECT_LT(text.find("| MI-MAX | 50 % [0, 100] |"), all) << "own parts alone\n" << text;
  EXPECT_NE(text.find("| MI-MAX | 50 % [9, 91] |", all), std::string::npos) << text;
  EXPECT_NE(text.find("in the intervals of all bins they are drawn together"), std::string::npos)
      << text;
}

// Two draws in the bin of own parts, one in that of CAD parts: 3 and 4 of 4 in the mean, 0 of 4.
TEST(NbvReport, TakesTheMeanOverDrawsBeforeItAddsBinsOfOneNumber) {
  Table table = no_rows();
  for (const auto& [types, draw, correct] :
       {std::tuple{"own", "0", "3"}, {"own", "1", "4"}, {"cad", "0", "0"}})
    table.rows.push_back(
        {"0", types, "all", "random", draw, "2", "light", "4", correct, "0", "4", "", "0", "0"});
  const std::string text = nbv_report({}, table).markdown;
  const std::size_t all = text.find("## all bins, three types, lightly occluded\n\n8 instances.");
  ASSERT_NE(all, std::string::npos) << text;
  EXPECT_NE(text.find("| Random | 43.8 %", all), std::string::npos) << text;
}

// Strategies that ended early in bins of other parts have nothing to be compared over, though the
// numbers are the same.
TEST(NbvReport, DistinguishesBinsOfOneNumberInComparisons) {
  Table table = no_rows();
  for (const auto& [types, strategy, views] : {std::tuple{"own", "mi-max", "1"},
                                               {"cad", "mi-max", "1"},
                                               {"own", "random", "1"},
                                               {"cad", "random", "1"},
                                               {"own", "mi-max", "2"},
                                               {"cad", "random", "2"}})
    table.rows.push_back(
        {"0", types, "all", strategy, "0", views, "light", "4", "2", "0", "4", "", "0", "0"});
  const std::string text = nbv_report({}, table).markdown;
  EXPECT_NE(text.find("| MI-MAX less Random | 0 |  |\n", text.find("## all bins")),
            std::string::npos)
      << text;
}

// A set with fewer tables than another does not move the panels of the next one into its rows.
TEST(NbvReport, KeepsARowASetAndMeasure) {
  Table table = no_rows();
  for (const auto& [types, group] : {std::pair{"own", "light"}, {"own", "heavy"}, {"cad", "heavy"}})
    table.rows.push_back(
        {"0", types, "all", "mi-max", "0", "1", group, "4", "2", "0", "4", "", "0", "0"});
  const Report report = nbv_report({}, table);
  EXPECT_EQ(report.columns, 2);
  std::vector<std::string> titles;
  for (const Panel& panel : report.panels) titles.push_back(panel.title);
  const std::string light = "three types, lightly occluded", heavy = "three types, highly occluded";
  EXPECT_EQ(titles, (std::vector<std::string>{light, heavy, light, heavy, "CAD parts, " + heavy, "",
                                              "CAD parts, " + heavy, "", "all bins, " + light,
                                              "all bins, " + heavy, "all bins, " + light,
                                              "all bins, " + heavy}));
}

// Strategies that ended early, each in another bin, have nothing to be compared over.
TEST(NbvReport, ComparesStrategiesInTheSameBinsAlone) {
  Table table = no_rows();
  const auto add = [&](const char* bin, const char* strategy, const char* views) {
    table.rows.push_back(
        {bin, "own", "all", strategy, "0", views, "light", "4", "2", "0", "4", "", "0", "0"});
  };
  for (const char* bin : {"0", "1"})
    for (const char* strategy : {"mi-max", "random"}) add(bin, strategy, "1");
  add("0", "mi-max", "2"), add("1", "random", "2");
  const Report report = nbv_report({}, table);
  EXPECT_NE(report.markdown.find("| MI-MAX less Random | 0 |  |\n"), std::string::npos)
      << report.markdown;
}

// The draws of one search do not apply to another search, which has one draw.
TEST(NbvReport, NamesTheSearchesWithSeveralDraws) {
  Table table = no_rows();
  for (const char* search : {"one", "all"})
    for (const char* strategy : {"mi-max", "random"})
      table.rows.push_back(
          {"0", "own", search, strategy, "0", "2", "light", "4", "3", "0", "4", "", "0", "0"});
  table.rows.push_back(
      {"0", "own", "all", "random", "1", "2", "light", "4", "2", "0", "4", "", "0", "0"});
  const std::string text = nbv_report({}, table).markdown;
  EXPECT_NE(text.find("Of three types Random's second view is the mean of 2 draws a bin"),
            std::string::npos)
      << text;
  EXPECT_EQ(text.find("Of one type Random's second view"), std::string::npos) << text;
}

// Three draws in one bin and two in the other: each bin counts once, by the mean over its draws.
TEST(NbvReport, TakesTheMeanOverDraws) {
  Table table = no_rows();
  const auto add = [&](const char* bin, const char* strategy, const char* draw, const char* views,
                       const char* correct, const char* wrong) {
    table.rows.push_back({bin, "own", "all", strategy, draw, views, "light", "4", correct, wrong,
                          "4", "", "0", "0"});
  };
  for (const char* bin : {"0", "1"})
    for (const char* strategy : {"mi-max", "random"}) {
      add(bin, strategy, "0", "1", "1", "0");
      add(bin, strategy, "0", "2", "3", "1");
      if (strategy == std::string("mi-max")) continue;
      add(bin, strategy, "1", "2", "2", "3");
      if (bin == std::string("0")) add(bin, strategy, "2", "2", "4", "2");
    }
  const Report report = nbv_report({}, table);
  EXPECT_NE(report.markdown.find("Random's second view is the mean of 3 draws a bin"),
            std::string::npos);
  EXPECT_NE(report.markdown.find("| 68.8 % [62, 75] |"), std::string::npos)
      << "3, 2, 4 and 3, 2 of 4\n"
      << report.markdown;
  EXPECT_NE(report.markdown.find("| 0 | -1.00 [-1.00, -1.00] |"), std::string::npos)
      << "1, 3, 2 and 1, 3 false ones instead of one\n"
      << report.markdown;
  EXPECT_NE(report.markdown.find("8 instances."), std::string::npos);
}

// Searches for each type in one bin are one cluster: of two bins that agree, the interval is
// Wilson's of two trials.
TEST(NbvReport, PoolsTheSearchesOfOneBin) {
  Table table = no_rows();
  for (const auto& [bin, correct, wrong] :
       {std::tuple{"0", "4", "0"}, {"0", "1", "3"}, {"1", "4", "0"}, {"1", "1", "3"}})
    table.rows.push_back(
        {bin, "own", "each", "mi-max", "0", "1", "light", "4", correct, wrong, "4", "", "0", "0"});
  const Report report = nbv_report({}, table);
  EXPECT_NE(report.markdown.find("## each type by itself, lightly occluded\n\n16 instances."),
            std::string::npos)
      << report.markdown;
  EXPECT_NE(report.markdown.find("| MI-MAX | 62.5 % [14, 94] |"), std::string::npos)
      << report.markdown;
  EXPECT_NE(report.markdown.find("| MI-MAX | 1.50 |"), std::string::npos) << report.markdown;
}

// Two bins of two views, counted by hand.
TEST(NbvReport, CountsInstancesAndFalseOnesByViews) {
  Table table = no_rows();
  const auto add = [&](const char* bin, const char* strategy, const char* views,
                       const char* instances, const char* correct, const char* wrong,
                       const char* shown = "3") {
    table.rows.push_back({bin, "own", "one", strategy, "0", views, "light", instances, correct,
                          wrong, shown, "1.5"});
    table.rows.push_back(
        {bin, "own", "one", strategy, "0", views, "heavy", "0", "0", "0", "0", "1.5"});
  };
  add("0", "mi-max", "1", "4", "1", "2"), add("0", "mi-max", "2", "4", "4", "0", "4");
  add("3", "mi-max", "1", "6", "2", "1"), add("3", "mi-max", "2", "6", "5", "1");
  add("0", "random", "1", "4", "1", "2"), add("0", "random", "2", "4", "2", "4");
  add("3", "random", "1", "6", "2", "1"), add("3", "random", "2", "6", "2", "3");
  const Report report = nbv_report({}, table);
  EXPECT_NE(report.markdown.find("Bins: 2 (numbers 0, 3)."), std::string::npos);
  EXPECT_NE(report.markdown.find("10 instances."), std::string::npos) << report.markdown;
  EXPECT_EQ(report.markdown.find("highly"), std::string::npos) << "no instances: no table";
  for (const char* rows : {"| Correctly localised | 1 view | 2 views |\n|---|---|---|\n"
                           "| MI-MAX | 30 % [25, 33] | 90 % [83, 100] |\n"
                           "| Random | 30 % [25, 33] | 40 % [33, 50] |\n"
                           "| MI-MAX less Random | 0 | +50.0 [+50.0, +50.0] |\n",
                           "| False positives a search | 1 view | 2 views |\n|---|---|---|\n"
                           "| MI-MAX | 1.50 | 0.50 |\n"
                           "| Random | 1.50 | 3.50 |\n"
                           "| MI-MAX less Random | 0 | -3.00 [-4.00, -2.00] |\n",
                           "| Shown by some image so far | 1 view | 2 views |\n|---|---|---|\n"
                           "| MI-MAX | 60 % [50, 75] | 70 % [50, 100] |\n"
                           "| Random | 60 % [50, 75] | 60 % [50, 75] |\n"
                           "| MI-MAX less Random | 0 | +10.0 [+0.0, +25.0] |\n"})
    EXPECT_NE(report.markdown.find(rows), std::string::npos) << rows << "not in\n"
                                                             << report.markdown;
  EXPECT_NE(report.markdown.find("Seconds of a step, median: MI-MAX 1.5, Random 1.5."),
            std::string::npos);
  ASSERT_EQ(report.panels.size(), 2u);
  EXPECT_EQ(report.panels[0].lines[0].name, "MI-MAX");
  EXPECT_DOUBLE_EQ(report.panels[0].lines[0].points[1].y, 0.9);
  EXPECT_DOUBLE_EQ(report.panels[1].lines[1].points[1].y, 3.5);
  EXPECT_DOUBLE_EQ(*report.panels[1].lines[1].points[1].high, 4);
}

}  // namespace
}  // namespace edgescout::test
