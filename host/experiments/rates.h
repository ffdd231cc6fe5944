// Rates of correct registrations by method and by the start's distance, as table and as plot.
#pragma once

#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "host/eval/intervals.h"
#include "host/experiments/plot.h"
#include "host/experiments/table.h"

namespace edgescout {

// What makes one row of a table and one line of a plot of the columns of trials.h.
struct Series {
  std::string name;
  std::function<bool(const Table&, std::size_t row)> has;
};

// Whether a registration counts as correct: the column "right", or a bound on "mspd_px".
struct Criterion {
  std::string text;
  std::function<bool(const Table&, std::size_t row)> holds;
};
Criterion pose_criterion();   // below 0.1 rad and 5 mm
Criterion image_criterion();  // no vertex 10 px or more from its place

// Starts nearer than this and at least as far as the one before belong together.
inline constexpr double LEVELS_RAD[] = {0.1, 0.2, 0.3, 0.4};
// Level 1 to 4 of a start's distance; distances of exactly 0.1 rad are level 1.
int level_of(double distance_rad);

// Registrations of a series that fall together, the images as clusters.
struct LevelRates {
  std::vector<Cluster> clusters[4];  // by level
  std::vector<Cluster> all;          // of all levels together
  std::vector<double> ms;  // of every registration whose time is known: its batch's mean; none of a
                           // table of several commits
};
LevelRates rates_of(const Table& table, const Series& series, const Criterion& criterion);

// Two series by their names: what the first has more than the other.
using Comparison = std::pair<std::string, std::string>;

// Markdown: a row a series, a column a level with its 95 % interval (bootstrap over images, of one
// image over its instances), starts and mean milliseconds; then a row a comparison of series that
// ran from the same starts, over the same draws; and over how many the intervals are.
std::string rate_table(const Table& table, const std::vector<Series>& series,
                       const Criterion& criterion, const std::vector<Comparison>& compared = {});
// The rate over the start's distance, in steps of 0.05 rad, or of 0.1 where all starts lie at the
// levels' ends.
Panel rate_panel(const std::string& title, const Table& table, const std::vector<Series>& series,
                 const Criterion& criterion);

// The rows that fit, columns and notes kept.
Table rows_where(const Table& table,
                 const std::function<bool(const Table&, std::size_t row)>& fits);
// Cells of several programs have no one time.
bool is_of_one_commit(const Table& table);
// Different texts of a column, in the order they come.
std::vector<std::string> values_of(const Table& table, std::string_view column);

std::string percent(double rate);                            // "87 %", "66.7 %"
std::string percent(double rate, const Interval& interval);  // "87 % [82, 91]"
// A difference of rates in points of percent: "+4.9 [+0.4, +9.4]".
std::string points(double difference, const Interval& interval);
double median(std::vector<double> values);       // 0 of none
double mean(const std::vector<double>& values);  // 0 of none

}  // namespace edgescout
