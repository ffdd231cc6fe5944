#include "host/experiments/rates.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <set>

#include "host/core/pose_error.h"

namespace edgescout {

namespace {

using Clusters =
    std::map<std::string, Cluster>;  // by image: registrations that are not independent

std::vector<Cluster> as_list(const Clusters& clusters) {
  std::vector<Cluster> list;
  for (const auto& [image, cluster] : clusters) list.push_back(cluster);
  return list;
}

std::string image_of(const Table& table, std::size_t row) {
  return text_in(table, row, "set") + "/" + text_in(table, row, "image");
}

// The clusters of a table: its images or, if it has one image, the instances in it.
class ClusterKeys {
 public:
  explicit ClusterKeys(const Table& table) : table_(table) {
    std::set<std::string> images;
    for (std::size_t row = 0; row < table.rows.size(); ++row) images.insert(image_of(table, row));
    by_image_ = images.size() > 1;
  }
  std::string of(std::size_t row) const {
    return by_image_ ? image_of(table_, row) : text_in(table_, row, "instance");
  }
  const char* name() const { return by_image_ ? "images" : "instances in one image"; }

 private:
  const Table& table_;
  bool by_image_;
};

void count(Clusters& clusters, const ClusterKeys& keys, const Table& table, std::size_t row,
           const Criterion& criterion) {
  Cluster& cluster = clusters[keys.of(row)];
  cluster.hits += criterion.holds(table, row);
  ++cluster.trials;
}

double trials_of(const std::vector<Cluster>& clusters) {
  double trials = 0;
  for (const Cluster& cluster : clusters) trials += cluster.trials;
  return trials;
}

// In percentage points; empty if the two did not run from the same starts.
std::string difference_text(const std::vector<Cluster>& a, const std::vector<Cluster>& b) {
  const auto trials = [](const Cluster& cluster) { return cluster.trials; };
  if (a.empty() || !std::ranges::equal(a, b, {}, trials, trials)) return "";
  return points(rate(a) - rate(b), paired_difference_interval(a, b));
}

std::string difference_row(const std::string& name, const LevelRates& first,
                           const LevelRates& other) {
  std::string text = "| " + name;
  for (std::size_t level = 0; level < std::size(LEVELS_RAD); ++level)
    text += " | " + difference_text(first.clusters[level], other.clusters[level]);
  return text + " | " + difference_text(first.all, other.all) + " | | |\n";
}

// A bootstrap over fewer than some ten clusters underestimates their spread.
std::string intervals_text(const Table& table) {
  constexpr std::size_t few = 10;
  const ClusterKeys keys(table);
  std::set<std::string> clusters;
  for (std::size_t row = 0; row < table.rows.size(); ++row) clusters.insert(keys.of(row));
  return fmt::format("\n95 % intervals by bootstrap over {} {}{}.\n", clusters.size(), keys.name(),
                     clusters.size() < few ? ", so few that the true ones are wider" : "");
}

// Recorded starts lie at the bounds of the levels, random ones anywhere.
double step_rad(const Table& table) {
  const auto is_end = [](const std::string& distance) {
    return std::ranges::any_of(LEVELS_RAD,
                               [&](double level) { return number_text(level) == distance; });
  };
  return std::ranges::all_of(values_of(table, "distance_rad"), is_end) ? 0.1 : 0.05;
}

PlotLine line_of(const Series& series, const Table& table, const Criterion& criterion,
                 double step) {
  std::map<int, Clusters> bins;
  const ClusterKeys keys(table);
  constexpr double SLACK = 1e-6;  // so that a distance rounded to six digits stays in its bin
  for (std::size_t row = 0; row < table.rows.size(); ++row)
    if (series.has(table, row))
      count(bins[static_cast<int>(std::ceil(number_in(table, row, "distance_rad") / step - SLACK))],
            keys, table, row, criterion);
  PlotLine line{series.name, {}};
  const bool at_the_end = step == 0.1;  // every start lies at the end of its bin; otherwise the
                                        // middle of the bin represents them
  for (const auto& [bin, clusters] : bins) {
    const std::vector<Cluster> list = as_list(clusters);
    const Interval interval = bootstrap_interval(list);
    line.points.push_back(
        {step * (at_the_end ? bin : bin - 0.5), rate(list), interval.low, interval.high});
  }
  return line;
}

}  // namespace

Criterion pose_criterion() {
  return {fmt::format("below {} rad and {} mm", number_text(CORRECT_ANGLE_RAD),
                      number_text(1000 * CORRECT_DISTANCE_M)),
          [](const Table& table, std::size_t row) { return text_in(table, row, "right") == "1"; }};
}

Criterion image_criterion() {
  return {fmt::format("MSPD < {} px", number_text(CORRECT_MSPD_PX)),
          [](const Table& table, std::size_t row) {
            return number_in(table, row, "mspd_px") < CORRECT_MSPD_PX;
          }};
}

int level_of(double distance_rad) {
  constexpr double SLACK = 1e-6;
  return std::clamp(static_cast<int>(std::ceil(distance_rad / LEVELS_RAD[0] - SLACK)), 1,
                    static_cast<int>(std::size(LEVELS_RAD)));
}

bool is_of_one_commit(const Table& table) {
  const auto commit =
      std::ranges::find(table.notes, "commit", &std::pair<std::string, std::string>::first);
  return commit == table.notes.end() || commit->second.find(' ') == std::string::npos;
}

LevelRates rates_of(const Table& table, const Series& series, const Criterion& criterion) {
  Clusters levels[std::size(LEVELS_RAD)], all;
  const ClusterKeys keys(table);
  const bool is_timed = is_of_one_commit(table);
  LevelRates rates;
  for (std::size_t row = 0; row < table.rows.size(); ++row) {
    if (!series.has(table, row)) continue;
    count(levels[level_of(number_in(table, row, "distance_rad")) - 1], keys, table, row, criterion);
    count(all, keys, table, row, criterion);
    if (is_timed && !text_in(table, row, "ms").empty())
      rates.ms.push_back(number_in(table, row, "ms"));
  }
  for (std::size_t level = 0; level < std::size(LEVELS_RAD); ++level)
    rates.clusters[level] = as_list(levels[level]);
  rates.all = as_list(all);
  return rates;
}

std::string rate_table(const Table& table, const std::vector<Series>& series,
                       const Criterion& criterion, const std::vector<Comparison>& compared) {
  std::string text =
      "| method | up to 0.1 rad, 5 mm | 0.2 / 10 | 0.3 / 15 | 0.4 / 20 | all | starts | mean ms "
      "|\n|---|---|---|---|---|---|---|---|\n";
  std::map<std::string, LevelRates> known;
  const auto rate_text = [](const std::vector<Cluster>& clusters) {
    return trials_of(clusters) > 0 ? percent(rate(clusters), bootstrap_interval(clusters)) : "";
  };
  for (const Series& one : series) {
    const LevelRates rates = rates_of(table, one, criterion);
    text += "| " + one.name;
    for (const std::vector<Cluster>& level : rates.clusters) text += " | " + rate_text(level);
    text += fmt::format(" | {} | {:.0f} | {} |\n", rate_text(rates.all), trials_of(rates.all),
                        rates.ms.empty() ? "" : fmt::format("{:.1f}", mean(rates.ms)));
    known.emplace(one.name, rates);
  }
  for (const auto& [first, other] : compared)
    if (known.contains(first) && known.contains(other))
      text += difference_row(first + " less " + other, known.at(first), known.at(other));
  return text + intervals_text(table);
}

Panel rate_panel(const std::string& title, const Table& table, const std::vector<Series>& series,
                 const Criterion& criterion) {
  Panel panel{
      title, "distance of the start, rad (0.1 rad with 5 mm)", "correct registrations", {}, 0, 1,
      false};
  const double step = step_rad(table);
  for (const Series& one : series)
    if (PlotLine line = line_of(one, table, criterion, step); !line.points.empty())
      panel.lines.push_back(std::move(line));
  return panel;
}

Table rows_where(const Table& table,
                 const std::function<bool(const Table&, std::size_t row)>& fits) {
  Table result{table.notes, table.columns, {}};
  for (std::size_t row = 0; row < table.rows.size(); ++row)
    if (fits(table, row)) result.rows.push_back(table.rows[row]);
  return result;
}

std::vector<std::string> values_of(const Table& table, std::string_view column) {
  std::vector<std::string> values;
  std::set<std::string> known;
  const std::size_t index = table.column(column);
  for (const std::vector<std::string>& row : table.rows)
    if (known.insert(row[index]).second) values.push_back(row[index]);
  return values;
}

std::string percent(double rate) {
  const bool is_whole = std::abs(100 * rate - std::round(100 * rate)) < 0.05;
  return fmt::format("{:.{}f} %", 100 * rate, is_whole ? 0 : 1);
}

std::string percent(double rate, const Interval& interval) {
  return fmt::format("{} [{:.0f}, {:.0f}]", percent(rate), 100 * interval.low, 100 * interval.high);
}

std::string points(double difference, const Interval& interval) {
  return fmt::format("{:+.1f} [{:+.1f}, {:+.1f}]", 100 * difference, 100 * interval.low,
                     100 * interval.high);
}

double median(std::vector<double> values) {
  if (values.empty()) return 0;
  std::ranges::sort(values);
  return 0.5 * (values[(values.size() - 1) / 2] + values[values.size() / 2]);
}

double mean(const std::vector<double>& values) {
  return values.empty() ? 0
                        : std::accumulate(values.begin(), values.end(), 0.0) /
                              static_cast<double>(values.size());
}

}  // namespace edgescout
