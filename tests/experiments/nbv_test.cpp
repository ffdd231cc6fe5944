#include "host/experiments/nbv.h"

#include <gtest/gtest.h>

#include <cstdlib>
#include <set>
#include <tuple>

#include "host/experiments/bin.h"
#include "host/experiments/bin_types.h"
#include "host/experiments/known_scene.h"
#include "host/render/parts.h"
#include "kernels/thread_pool.h"

namespace edgescout::test {
namespace {

ExperimentSettings small() {
  ExperimentSettings settings;
  settings.image_scale = 0.25;
  settings.supersampling = 1;
  return settings;
}

TEST(MakeBin, IsTheSameBinEveryTimeAndAnotherForEveryNumber) {
  ThreadPool pool(2);
  const std::vector<Object> types{make_part("l_bracket"), make_part("bearing_block"),
                                  make_part("u_channel")};
  Bin a = make_bin(types, small(), 3, pool), b = make_bin(types, small(), 3, pool),
      c = make_bin(types, small(), 4, pool);
  EXPECT_EQ(a.first_view, b.first_view);
  ASSERT_EQ(a.instances.size(), b.instances.size());
  for (std::size_t i = 0; i < a.instances.size(); ++i) {
    EXPECT_EQ(a.instances[i].object, b.instances[i].object);
    EXPECT_EQ(
        distance_between_m(a.instances[i].world_from_object, b.instances[i].world_from_object), 0);
    EXPECT_EQ(a.instances[i].visible, b.instances[i].visible);
  }
  EXPECT_EQ(a.cell->acquire(7).image.pixels, b.cell->acquire(7).image.pixels);
  EXPECT_NE(a.cell->acquire(7).image.pixels, c.cell->acquire(7).image.pixels);
}

// Five to twenty parts, each of a type, in front of every view at the distances the templates are
// made for.
TEST(MakeBin, HoldsItsPromises) {
  ThreadPool pool(2);
  const std::vector<Object> types{make_part("l_bracket"), make_part("bearing_block"),
                                  make_part("u_channel")};
  for (int number = 0; number < 6; ++number) {
    const Bin bin = make_bin(types, small(), number, pool);
    EXPECT_GE(bin.parts, FEWEST_PARTS_OF_BIN);
    EXPECT_LE(bin.parts, MOST_PARTS_OF_BIN);
    EXPECT_EQ(static_cast<int>(bin.instances.size()), bin.parts);
    EXPECT_EQ(static_cast<int>(bin.cell->views().size()), bin_views().count);
    double most_visible = 0;
    for (const BinInstance& instance : bin.instances) {
      most_visible = std::max(most_visible, instance.visible);
      EXPECT_GE(instance.visible, 0);
      EXPECT_LE(instance.visible, 1);
      const Eigen::Vector3d center =
          types[static_cast<std::size_t>(instance.object)].mesh.box_min_m / 2 +
          types[static_cast<std::size_t>(instance.object)].mesh.box_max_m / 2;
      for (const Se3& view : bin.cell->views())
        EXPECT_NEAR((view * (instance.world_from_object * center)).norm(), bin_views().radius_m,
                    BIN_DEPTH_MARGIN_M);
    }
    EXPECT_GT(most_visible, LIGHTLY_OCCLUDED);
  }
}

// The visible fraction of an instance is what its own images show: more or less behind another.
TEST(BinCell, GivesTheVisibleFractionInEveryView) {
  ThreadPool pool(2);
  const std::vector<Object> types{make_part("l_bracket"), make_part("bearing_block"),
                                  make_part("u_channel")};
  const Bin bin = make_bin(types, small(), 1, pool);
  double most = 0, least = 1;
  for (const BinInstance& instance : bin.instances) {
    EXPECT_EQ(bin.cell->visible(bin.first_view)[instance.placed], instance.visible);
    EXPECT_EQ(instance.most_visible, instance.visible) << "of the first image so far";
    for (int view = 0; view < 3; ++view) {
      most = std::max(most, bin.cell->visible(view)[instance.placed]);
      least = std::min(least, bin.cell->visible(view)[instance.placed]);
    }
  }
  EXPECT_GT(most, 0.95);
  EXPECT_LT(least, 0.6);
}

// Against every second view there is.
TEST(ClairvoyantSequence, TakesTheViewThatShowsMost) {
  ThreadPool pool(2);
  const std::vector<Object> types{make_part("l_bracket"), make_part("bearing_block"),
                                  make_part("u_channel")};
  const Bin bin = make_bin(types, small(), 1, pool);
  const auto shown = [&](int second) {
    double sum = 0;
    for (const BinInstance& instance : bin.instances)
      sum += std::min(1.0, std::max(0.0, instance.visible - 0.3) +
                               std::max(0.0, bin.cell->visible(second)[instance.placed] - 0.3));
    return sum;
  };
  const std::vector<int> sequence = clairvoyant_sequence(bin, bin.instances, 5);
  ASSERT_EQ(sequence.size(), 5u);
  EXPECT_EQ(sequence[0], bin.first_view);
  EXPECT_EQ(std::set(sequence.begin(), sequence.end()).size(), 5u) << "no view twice";
  for (int view = 0; view < bin_views().count; ++view)
    EXPECT_TRUE(view == bin.first_view || shown(view) <= shown(sequence[1])) << view;
}

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

// Meshes of other authors, if present: centred on their boxes, and as symmetric as stated: a turned
// vertex is near another one, as far as the tessellation has one there.
TEST(CadBinTypes, AreCentredAndHaveTheirStatedSymmetry) {
  const char* data = std::getenv("EDGESCOUT_DATA");
  if (!data || !std::filesystem::exists(std::filesystem::path(data) / "cad"))
    GTEST_SKIP() << "EDGESCOUT_DATA names no folder with cad";
  const std::vector<Object> types = cad_bin_types(data);
  ASSERT_EQ(types.size(), 3u);
  for (const Object& type : types) {
    EXPECT_LT((type.mesh.box_min_m + type.mesh.box_max_m).norm(), 1e-9) << type.mesh.name;
    EXPECT_GT(type.mesh.diameter_m, 0.04) << type.mesh.name << ": the unit";
    EXPECT_LT(type.mesh.diameter_m, 0.15) << type.mesh.name << ": the unit";
    for (const Eigen::Vector3d axis :
         {Eigen::Vector3d::UnitX(), Eigen::Vector3d::UnitY(), Eigen::Vector3d::UnitZ()}) {
      const Eigen::Quaterniond turn(Eigen::AngleAxisd(std::acos(-1.0), axis));
      double worst_m = 0;
      for (const Eigen::Vector3d& vertex_m : type.mesh.vertices_m) {
        double nearest_m = 1;
        for (const Eigen::Vector3d& other_m : type.mesh.vertices_m)
          nearest_m = std::min(nearest_m, (turn * vertex_m - other_m).norm());
        worst_m = std::max(worst_m, nearest_m);
      }
      bool is_said = false;
      for (const Se3& symmetry : type.symmetries.discrete)
        is_said |= std::abs(symmetry.rotation.dot(turn)) > 0.999;
      EXPECT_EQ(worst_m < 0.004, is_said)
          << type.mesh.name << " about " << axis.transpose() << ": " << worst_m;
    }
  }
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
