#include "host/experiments/plot.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <regex>

#include "tests/experiments/well_formed.h"

namespace edgescout::test {
namespace {

constexpr double INF = std::numeric_limits<double>::infinity();

Panel panel() {
  Panel panel{"rates <of> \"A & B\"", "distance", "rate", {}, 0, 1, false};
  panel.lines.push_back({"first", {{0, 0.5, 0.4, 0.6}, {1, 0.25, 0.2, 0.3}, {2, 0, 0, 0.1}}});
  panel.lines.push_back({"second & last", {{0, 1, {}, {}}, {2, 0.75, {}, {}}}});
  return panel;
}

// The points of the curves, in the order they are drawn.
std::vector<std::vector<std::pair<double, double>>> curves_in(const std::string& svg) {
  std::vector<std::vector<std::pair<double, double>>> curves;
  const std::regex line("<polyline class=\"curve\" points=\"([^\"]*)\""),
      point("([-0-9.]+),([-0-9.]+)");
  for (std::sregex_iterator l(svg.begin(), svg.end(), line), end; l != end; ++l) {
    const std::string points = (*l)[1];
    curves.emplace_back();
    for (std::sregex_iterator p(points.begin(), points.end(), point); p != end; ++p)
      curves.back().emplace_back(std::stod((*p)[1]), std::stod((*p)[2]));
  }
  return curves;
}

TEST(Ticks, AreRoundAndCoverTheRange) {
  EXPECT_EQ(tick_values(0, 1), (std::vector<double>{0, 0.2, 0.4, 0.6000000000000001, 0.8, 1}));
  EXPECT_EQ(tick_values(0, 10, 5), (std::vector<double>{0, 2, 4, 6, 8, 10}));
  EXPECT_EQ(tick_values(-3, 12, 5), (std::vector<double>{-5, 0, 5, 10, 15}));
  EXPECT_EQ(tick_values(120, 480, 4), (std::vector<double>{100, 200, 300, 400, 500}));
}

TEST(Ticks, OfOnePlaceHaveARange) {
  const std::vector<double> ticks = tick_values(3, 3);
  ASSERT_GE(ticks.size(), 2u);
  EXPECT_LE(ticks.front(), 3);
  EXPECT_GE(ticks.back(), 3);
}

TEST(Plot, IsWellFormed) {
  EXPECT_EQ(fault_of_xml(svg_of(std::vector{panel(), panel(), panel(), panel()})), "");
  EXPECT_EQ(fault_of_xml(svg_of({})), "");
  EXPECT_EQ(fault_of_xml(svg_of({}, 3, "lambda < 5 & \"seed\" 1")), "");
  EXPECT_EQ(fault_of_xml(svg_of(std::vector{Panel{}})), "");
}

TEST(Plot, PutsValuesWhereTheAxesSay) {
  const std::string svg = svg_of(std::vector{panel()});
  const auto curves = curves_in(svg);
  ASSERT_EQ(curves.size(), 2u);
  ASSERT_EQ(curves[0].size(), 3u);
  // Equal steps to the right; y falls on the page as the rate rises, in proportion.
  EXPECT_NEAR(curves[0][1].first - curves[0][0].first, curves[0][2].first - curves[0][1].first,
              0.11);
  const double y_of_0 = curves[0][2].second, y_of_1 = curves[1][0].second;
  EXPECT_GT(y_of_0, y_of_1 + 100);
  EXPECT_NEAR(curves[0][0].second, 0.5 * (y_of_0 + y_of_1), 0.11);
  EXPECT_NEAR(curves[0][1].second, 0.75 * y_of_0 + 0.25 * y_of_1, 0.11);
  // The axes' box spans exactly the ticks: 0 to 2 and 0 to 1.
  std::smatch box;
  ASSERT_TRUE(std::regex_search(svg, box,
                                std::regex("<rect class=\"axes\" x=\"([0-9.]+)\" y=\"([0-9.]+)\" "
                                           "width=\"([0-9.]+)\" height=\"([0-9.]+)\"")));
  EXPECT_NEAR(curves[0][0].first, std::stod(box[1]), 0.11);
  EXPECT_NEAR(curves[0][2].first, std::stod(box[1]) + std::stod(box[3]), 0.11);
  EXPECT_NEAR(y_of_1, std::stod(box[2]), 0.11);
  EXPECT_NEAR(y_of_0, std::stod(box[2]) + std::stod(box[4]), 0.11);
}

TEST(Plot, SpreadsDecadesEvenly) {
  Panel p = panel();
  p.logarithmic_x = true;
  p.lines = {{"a", {{0, 1, {}, {}}, {0.1, 0, {}, {}}, {1, 0, {}, {}}, {10, 1, {}, {}}}}};
  const auto curves = curves_in(svg_of(std::vector{p}));
  ASSERT_EQ(curves.at(0).size(), 3u) << "what is not above 0 has no place";
  EXPECT_NEAR(curves[0][1].first - curves[0][0].first, curves[0][2].first - curves[0][1].first,
              0.11);
}

TEST(Plot, LeavesOutWhatIsNoNumber) {
  Panel p = panel();
  p.lines = {
      {"a", {{0, 0.5, {}, {}}, {1, INF, {}, {}}, {std::nan(""), 0.1, {}, {}}, {2, 1, {}, {}}}}};
  const std::string svg = svg_of(std::vector{p});
  EXPECT_EQ(curves_in(svg).at(0).size(), 2u);
  EXPECT_EQ(svg.find("nan"), std::string::npos);
  EXPECT_EQ(svg.find("inf"), std::string::npos);
}

TEST(Plot, GivesOneNameOneColourInAllPanels) {
  Panel other = panel();
  std::swap(other.lines[0], other.lines[1]);
  const std::string svg = svg_of(std::vector{panel(), other});
  std::vector<std::string> colours;
  const std::regex curve("<polyline class=\"curve\" points=\"[^\"]*\" stroke=\"([^\"]*)\"");
  for (std::sregex_iterator i(svg.begin(), svg.end(), curve), end; i != end; ++i)
    colours.push_back((*i)[1]);
  ASSERT_EQ(colours.size(), 4u);
  EXPECT_EQ(colours[0], colours[3]);
  EXPECT_EQ(colours[1], colours[2]);
  EXPECT_NE(colours[0], colours[1]);
}

}  // namespace
}  // namespace edgescout::test
