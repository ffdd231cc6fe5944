// Computes rates of correct registrations by method and by the start's distance, as tables and
// plots.
#pragma once

#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "host/eval/intervals.h"
#include "host/experiments/plot.h"
#include "host/experiments/table.h"

namespace edgescout {

// The rows of a table of trials.h that make one row of a report's table and one line of its plot.
struct Series {
  std::string name;
  std::function<bool(const Table&, std::size_t row)> has;
};

// Decides whether a registration is correct: by the column "right" or by a bound on "mspd_px".
struct Criterion {
  std::string text;
  std::function<bool(const Table&, std::size_t row)> holds;
};
Criterion pose_criterion();   // below 0.1 rad and 5 mm
Criterion image_criterion();  // all vertices less than 10 px from their places

// Upper bounds of the levels of a start's distance.
inline constexpr double LEVELS_RAD[] = {0.1, 0.2, 0.3, 0.4};
// Returns level 1 to 4. A distance of exactly 0.1 rad is level 1.
int level_of(double distance_rad);

// The registrations of a series. Each image is a cluster.
struct LevelRates {
  std::vector<Cluster> clusters[4];  // by level
  std::vector<Cluster> all;          // of all levels
  // Time of every registration for which it is known: the mean of its batch. Empty for a table of
  // several commits.
  std::vector<double> ms;
};
LevelRates rates_of(const Table& table, const Series& series, const Criterion& criterion);

// The names of two series. Their difference is the first less the second.
using Comparison = std::pair<std::string, std::string>;

// Returns Markdown with one row per series: for every level the rate and its 95 % interval
// (bootstrap over images; with a single image over its instances), the number of starts and the
// mean milliseconds. Then follows one row per comparison of two series that ran from the same
// starts, over the same draws. The last line says how many clusters the intervals have.
std::string rate_table(const Table& table, const std::vector<Series>& series,
                       const Criterion& criterion, const std::vector<Comparison>& compared = {});
// Plots the rate over the start's distance, in steps of 0.05 rad, or of 0.1 if all starts lie at
// the bounds of the levels.
Panel rate_panel(const std::string& title, const Table& table, const std::vector<Series>& series,
                 const Criterion& criterion);

// Returns the rows for which `fits` holds, with all columns and notes.
Table rows_where(const Table& table,
                 const std::function<bool(const Table&, std::size_t row)>& fits);
// Returns whether all cells were made by one commit. Times of several commits are not comparable.
bool is_of_one_commit(const Table& table);
// Returns the different texts of a column, in order of appearance.
std::vector<std::string> values_of(const Table& table, std::string_view column);

std::string percent(double rate);                            // "87 %", "66.7 %"
std::string percent(double rate, const Interval& interval);  // "87 % [82, 91]"
// A difference of rates in percentage points: "+4.9 [+0.4, +9.4]".
std::string points(double difference, const Interval& interval);
double median(std::vector<double> values);       // 0 without values
double mean(const std::vector<double>& values);  // 0 without values

}  // namespace edgescout
