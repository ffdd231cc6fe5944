#include <fmt/format.h>

#include <algorithm>
#include <set>

#include "host/experiments/nbv.h"
#include "host/experiments/rates.h"

namespace edgescout {

namespace {

struct Searched {
  std::string search, group, title;
};

// The result in one bin: the mean of its draws. In `wrong` the trials are searches.
struct BinOutcome {
  std::string number, types;
  std::set<std::string> draws = {};
  Cluster correct = {}, wrong = {}, shown = {};
};

struct Outcome {
  std::vector<std::string> bins;  // number and types of each
  // One per bin number: bins of one number have the same random layout, whatever their parts, so
  // they are not independent samples.
  std::vector<Cluster> correct, wrong, shown;
};

std::string name_of(const std::string& strategy) {
  if (strategy == "mi-max") return "MI-MAX";
  if (strategy == "dis") return "DIS";
  if (strategy == CLAIRVOYANT) return "Clairvoyant";
  return strategy == "random" ? "Random" : "Fixed";
}

std::string title_of(const std::string& search) {
  if (search == "each") return "each type by itself";
  return search == "one" ? "one type" : "three types";
}

Table rows_of(const Table& table, const Searched& searched, const std::string& strategy) {
  return rows_where(table, [&](const Table& t, std::size_t row) {
    return text_in(t, row, "search") == searched.search &&
           text_in(t, row, "group") == searched.group && text_in(t, row, "strategy") == strategy;
  });
}

// A set of bins with tables in the report: bins of one kind of parts, or all.
struct BinSet {
  std::string types, prefix;  // `types` empty: all
};

std::vector<std::string> kinds_of_rendered_bins(const Table& table) {
  std::vector<std::string> kinds = values_of(table, "types");
  std::erase(kinds, PHOTOGRAPHED_BINS);
  return kinds;
}

Table rows_of_set(const Table& table, const std::string& types) {
  return rows_where(table, [&](const Table& t, std::size_t row) {
    const std::string& kind = text_in(t, row, "types");
    return types.empty() ? kind != PHOTOGRAPHED_BINS : kind == types;
  });
}

std::vector<BinSet> sets_in(const Table& table) {
  std::vector<BinSet> sets;
  for (const std::string& types : kinds_of_rendered_bins(table))
    sets.push_back({types, types == "own" ? "" : "CAD parts, "});
  if (sets.size() > 1) sets.push_back({"", "all bins, "});
  if (!rows_of_set(table, PHOTOGRAPHED_BINS).rows.empty())
    sets.push_back({PHOTOGRAPHED_BINS, "photographs, "});
  return sets;
}

// The searches that have instances.
std::vector<Searched> searches_in(const Table& table, const BinSet& set) {
  std::vector<Searched> list;
  for (const std::string& search : values_of(table, "search"))
    for (const auto& [group, text] :
         {std::pair{"light", "lightly occluded"}, {"heavy", "highly occluded"}}) {
      const Table rows = rows_where(table, [&, g = group](const Table& t, std::size_t row) {
        return text_in(t, row, "search") == search && text_in(t, row, "group") == g &&
               number_in(t, row, "instances") > 0;
      });
      if (!rows.rows.empty())
        list.push_back(
            {search, group, fmt::format("{}{}, {}", set.prefix, title_of(search), text)});
    }
  return list;
}

void add(Cluster& cluster, double hits, double trials) {
  cluster.hits += hits;
  cluster.trials += trials;
}

BinOutcome& bin_of(std::vector<BinOutcome>& bins, const std::string& number,
                   const std::string& types) {
  const auto known = std::ranges::find_if(
      bins, [&](const BinOutcome& bin) { return bin.number == number && bin.types == types; });
  return known == bins.end() ? bins.emplace_back(BinOutcome{number, types}) : *known;
}

// The result after so many views, pooled over all searches in a bin.
std::vector<BinOutcome> bins_after(const Table& rows, const std::string& views) {
  std::vector<BinOutcome> bins;
  for (std::size_t row = 0; row < rows.rows.size(); ++row) {
    if (text_in(rows, row, "views") != views) continue;
    BinOutcome& bin = bin_of(bins, text_in(rows, row, "bin"), text_in(rows, row, "types"));
    bin.draws.insert(text_in(rows, row, "draw"));
    // The true pose of a photographed part is only known in the image.
    const bool in_image = bin.types == PHOTOGRAPHED_BINS;
    add(bin.correct, number_in(rows, row, in_image ? "correct_px" : "correct"),
        number_in(rows, row, "instances"));
    add(bin.wrong, number_in(rows, row, in_image ? "wrong_px" : "wrong"), 1);
    add(bin.shown, number_in(rows, row, "shown"), number_in(rows, row, "instances"));
  }
  for (BinOutcome& bin : bins)
    for (Cluster* cluster : {&bin.correct, &bin.wrong, &bin.shown}) {
      cluster->hits /= static_cast<double>(bin.draws.size());
      cluster->trials /= static_cast<double>(bin.draws.size());
    }
  return bins;
}

Outcome outcome_of(const Table& rows, const std::string& views) {
  Outcome outcome;
  std::vector<std::string> numbers;
  for (const BinOutcome& bin : bins_after(rows, views)) {
    outcome.bins.push_back(bin.types + " " + bin.number);
    const auto index =
        static_cast<std::size_t>(std::ranges::find(numbers, bin.number) - numbers.begin());
    if (index == numbers.size()) numbers.push_back(bin.number);
    for (const auto& [clusters, cluster] : {std::pair{&outcome.correct, &bin.correct},
                                            {&outcome.wrong, &bin.wrong},
                                            {&outcome.shown, &bin.shown}}) {
      clusters->resize(numbers.size());
      add((*clusters)[index], cluster->hits, cluster->trials);
    }
  }
  return outcome;
}

enum class Measure { Correct, Wrong, Shown };

const std::vector<Cluster>& clusters_of(const Outcome& outcome, Measure measure) {
  if (measure == Measure::Correct) return outcome.correct;
  return measure == Measure::Wrong ? outcome.wrong : outcome.shown;
}

std::string title_of(Measure measure) {
  if (measure == Measure::Correct) return "Correctly localised";
  return measure == Measure::Wrong ? "False positives a search" : "Shown by some image so far";
}

PlotPoint point_of(double x, const std::vector<Cluster>& clusters) {
  PlotPoint point{x, rate(clusters), {}, {}};
  if (clusters.size() < 2) return point;
  const Interval interval = bootstrap_interval(clusters);
  point.low = interval.low, point.high = interval.high;
  return point;
}

// The results of the strategies after each number of views: [strategy][views].
using Outcomes = std::vector<std::vector<Outcome>>;

std::string cell_of(const std::vector<Cluster>& clusters, Measure measure) {
  if (measure == Measure::Wrong) return fmt::format("{:.2f}", rate(clusters));
  return percent(rate(clusters), bootstrap_interval(clusters));
}

// The difference of two strategies, over the same draws of bins.
std::string difference_of(const Outcome& a, const Outcome& b, Measure measure) {
  if (a.bins != b.bins) return "";  // in some bins one of them ended earlier
  const std::vector<Cluster>&these = clusters_of(a, measure), &those = clusters_of(b, measure);
  if (std::ranges::equal(these, those, {}, &Cluster::hits, &Cluster::hits)) return "0";
  const double more = rate(these) - rate(those);
  const Interval interval = paired_difference_interval(these, those);
  if (measure == Measure::Wrong)
    return fmt::format("{:+.2f} [{:+.2f}, {:+.2f}]", more, interval.low, interval.high);
  return points(more, interval);
}

// One row per strategy, and one row per difference between the first strategy and another.
std::string table_of(const Outcomes& outcomes, const std::vector<std::string>& strategies,
                     const std::vector<std::string>& views, Measure measure) {
  std::string text = fmt::format("| {} |", title_of(measure)), line = "|---|";
  for (const std::string& count : views)
    text += fmt::format(" {} {} |", count, count == "1" ? "view" : "views"), line += "---|";
  text += fmt::format("\n{}\n", line);
  for (std::size_t i = 0; i < strategies.size(); ++i) {
    text += fmt::format("| {} |", name_of(strategies[i]));
    for (const Outcome& outcome : outcomes[i])
      text += fmt::format(" {} |", cell_of(clusters_of(outcome, measure), measure));
    text += "\n";
  }
  for (std::size_t i = 1; i < strategies.size(); ++i) {
    text += fmt::format("| {} less {} |", name_of(strategies[0]), name_of(strategies[i]));
    for (std::size_t v = 0; v < views.size(); ++v)
      text += fmt::format(" {} |", difference_of(outcomes[0][v], outcomes[i][v], measure));
    text += "\n";
  }
  return text + "\n";
}

bool all_shown(const Outcomes& outcomes) {
  return std::ranges::all_of(outcomes, [](const std::vector<Outcome>& of_strategy) {
    return std::ranges::all_of(of_strategy,
                               [](const Outcome& outcome) { return rate(outcome.shown) == 1; });
  });
}

std::string tables_of(const Table& table, const Searched& searched,
                      const std::vector<std::string>& strategies,
                      const std::vector<std::string>& views) {
  Outcomes outcomes;
  for (const std::string& strategy : strategies) {
    const Table rows = rows_of(table, searched, strategy);
    std::vector<Outcome>& of_strategy = outcomes.emplace_back();
    for (const std::string& count : views) of_strategy.push_back(outcome_of(rows, count));
  }
  double instances = 0;  // the same for every strategy
  for (const Cluster& cluster : outcomes[0][0].correct) instances += cluster.trials;
  std::string text = fmt::format("## {}\n\n{:.0f} instances.\n\n", searched.title, instances);
  for (const Measure measure : {Measure::Correct, Measure::Wrong, Measure::Shown})
    if (measure != Measure::Shown || !all_shown(outcomes))
      text += table_of(outcomes, strategies, views, measure);
  return text;
}

// `numbers` must ascend: "0 to 3, 7".
std::string ranges_text(const std::vector<int>& numbers) {
  std::string text;
  for (std::size_t first = 0, last = 0; first < numbers.size(); first = ++last) {
    while (last + 1 < numbers.size() && numbers[last + 1] == numbers[last] + 1) ++last;
    text += fmt::format("{}{}", text.empty() ? "" : ", ", numbers[first]);
    if (last > first) text += fmt::format(" to {}", numbers[last]);
  }
  return text;
}

// Names the searches in which a strategy has more than one draw.
std::string draws_text(const Table& table) {
  std::string text;
  for (const std::string& search : values_of(table, "search")) {
    const Table rows = rows_where(table, [&](const Table& t, std::size_t row) {
      return text_in(t, row, "search") == search;
    });
    if (const std::size_t draws = values_of(rows, "draw").size(); draws > 1)
      text += fmt::format(
          " Of {} Random's second view is the mean of {} draws a bin, later ones those of the "
          "first.",
          title_of(search), draws);
  }
  return text;
}

// Empty unless there are both kinds of parts.
std::string pairs_text(const Table& table) {
  if (kinds_of_rendered_bins(table).size() < 2) return "";
  return " Bins of one number share number of parts, first view and random views, whatever the "
         "parts: in the "
         "intervals of all bins they are drawn together.";
}

// Empty without photographs.
std::string photographs_text(const Table& table) {
  const std::size_t first_views = values_of(rows_of_set(table, PHOTOGRAPHED_BINS), "bin").size();
  if (first_views == 0) return "";
  return fmt::format(
      " Photographs: one pile, {} of its views in turn the first, the others to choose from; "
      "correct is {}; "
      "nobody knows how much of a part shows, so that all count as lightly occluded. The intervals "
      "take the "
      "first views for independent piles.",
      first_views, image_criterion().text);
}

// The number of bins of each kind of parts and the numbers that reproduce them.
std::string bins_text(const Table& table) {
  std::string text;
  for (const std::string& types : kinds_of_rendered_bins(table)) {
    std::vector<int> numbers;
    for (const std::string& bin : values_of(rows_of_set(table, types), "bin"))
      numbers.push_back(std::stoi(bin));
    std::ranges::sort(numbers);
    text += fmt::format("{}{}{} (numbers {})", text.empty() ? "" : " and ", numbers.size(),
                        types == "own" ? "" : " of CAD parts", ranges_text(numbers));
  }
  return text;
}

Panel panel_of(const Table& table, const Searched& searched,
               const std::vector<std::string>& strategies, const std::vector<std::string>& views,
               Measure measure) {
  Panel panel{searched.title,
              "views",
              measure == Measure::Correct ? "correct localisations" : "false positives a search",
              {},
              0,
              1,
              false};
  for (const std::string& strategy : strategies) {
    const Table rows = rows_of(table, searched, strategy);
    PlotLine line{name_of(strategy), {}};
    for (std::size_t i = 0; i < views.size(); ++i) {
      const Outcome outcome = outcome_of(rows, views[i]);
      line.points.push_back(point_of(static_cast<double>(i + 1), clusters_of(outcome, measure)));
    }
    panel.lines.push_back(std::move(line));
  }
  return panel;
}

std::string times_text(const Table& table) {
  if (!is_of_one_commit(table)) return "";
  std::string text;
  for (const std::string& strategy : values_of(table, "strategy")) {
    std::vector<double> seconds;
    for (std::size_t row = 0; row < table.rows.size(); ++row)
      if (text_in(table, row, "strategy") == strategy && text_in(table, row, "group") == "light" &&
          text_in(table, row, "views") != "1" && text_in(table, row, "draw") == "0" &&
          !text_in(table, row, "seconds").empty())
        seconds.push_back(number_in(table, row, "seconds"));
    if (!seconds.empty())
      text +=
          fmt::format("{}{} {:.1f}", text.empty() ? "" : ", ", name_of(strategy), median(seconds));
  }
  if (text.empty()) return "";
  return fmt::format(
      "Seconds of a step, median: {}. That is the decision, and what its image brings; an image's "
      "scan is "
      "the "
      "step's of the strategy that looked from there first. On a CPU as many bins run side by side "
      "as it has "
      "threads.\n",
      text);
}

}  // namespace

// Figure 15's order: (a) to (d) rates, (e) to (h) false positives.
Report nbv_report(const ExperimentSettings&, const Table& table) {
  Report report;
  report.markdown = fmt::format(
      "Bins: {}. Correctly localised: {}, after so many views. Shown by some image so far: more "
      "than 70 % of "
      "the instance; where all are, there is no such table. Differences in points of percent, "
      "their "
      "intervals "
      "over the same draws of bins; 0: the same in every bin. MI-MAX is edgescout's choice, the "
      "paper's "
      "mutual information with the terms of docs/research/next_view.md.{}{}{}\n\n",
      bins_text(table), pose_criterion().text, pairs_text(table),
      draws_text(rows_of_set(table, "")), photographs_text(table));
  const auto rows_in = [&](const BinSet& set) { return rows_of_set(table, set.types); };
  std::size_t columns = 1;
  for (const BinSet& set : sets_in(table))
    columns = std::max(columns, searches_in(rows_in(set), set).size());
  report.columns = static_cast<int>(columns);
  for (const BinSet& set : sets_in(table)) {
    const Table rows = rows_in(set);
    // Photographs have fewer views and no clairvoyant strategy.
    const std::vector<std::string> views = values_of(rows, "views"),
                                   strategies = values_of(rows, "strategy");
    const std::vector<Searched> searches = searches_in(rows, set);
    for (const Searched& searched : searches)
      report.markdown += tables_of(rows, searched, strategies, views);
    for (const Measure measure : {Measure::Correct, Measure::Wrong}) {
      for (const Searched& searched : searches)
        report.panels.push_back(panel_of(rows, searched, strategies, views, measure));
      report.panels.resize((report.panels.size() + columns - 1) / columns *
                           columns);  // each measure has its own rows
    }
  }
  report.markdown += times_text(table);
  return report;
}

}  // namespace edgescout
