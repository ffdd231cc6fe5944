#include "host/experiments/registration.h"

#include <fmt/format.h>

#include <algorithm>
#include <set>

#include "host/baselines/baseline.h"
#include "host/core/log.h"
#include "host/experiments/data_mark.h"
#include "host/experiments/photographs.h"
#include "host/experiments/rates.h"
#include "host/experiments/recorded_starts.h"
#include "host/experiments/trials.h"

namespace edgescout {

namespace fs = std::filesystem;

namespace {

// Suffix of the name of sets with starts_by_distance.
constexpr const char* BY_DISTANCE = " by distance";

Trial as_in_the_original() { return {"d2co", 1, PAPER_LAMBDA_PX_PER_RAD, ORIGINAL_SMOOTHING}; }

std::vector<Trial> trials() {
  std::vector<Trial> list{{"edgescout", 1}};
  for (const Method method : all_methods()) list.push_back({to_string(method), 1});
  for (const char* method : {"d2co", "dc-icp"}) list.push_back({method, 1, OWN_LAMBDA_PX_PER_RAD});
  list.push_back(as_in_the_original());
  return list;
}

Notes options(const ExperimentSettings& s) {
  Notes notes{{"scenes", std::to_string(s.scenes)},
              {"starts", std::to_string(s.starts)},
              {"image_scale", number_text(s.image_scale)},
              {"supersampling", std::to_string(s.supersampling)}};
  std::ranges::copy(trial_notes(s), std::back_inserter(notes));
  if (s.data.empty()) return notes;
  notes.emplace_back("data", data_mark(s.data));
  notes.emplace_back("every", std::to_string(s.every));
  notes.emplace_back("frames_every", std::to_string(s.frames_every));
  return notes;
}

Table run_recorded(const fs::path& folder, const std::string& image,
                   const ExperimentSettings& settings, Backend& backend) {
  const KnownScene scene = recorded_scene(folder, image, 0);
  return run_trials(scene, as_starts(recorded_starts(folder, scene, settings.every)), trials(),
                    settings, backend);
}

std::vector<Cell> cells(const ExperimentSettings& s) {
  std::vector<Cell> list;
  for (int number = 0; number < s.scenes; ++number) {
    const std::string name = fmt::format("scene_{:03}", number);
    list.push_back(
        {"rendered/" + name, [s, number, name](Backend& backend) {
           const KnownScene scene = rendered_scene(
               name, rendered_types(), single_image_options(s, number), backend.threads());
           return run_trials(scene, starts_around(scene, s.starts, s.seed), trials(), s, backend);
         }});
  }
  if (s.data.empty()) return list;
  const fs::path recorded = s.data / "d2co-starts";
  for (const std::string& image : recorded_images(recorded))
    list.push_back({"d2co-starts/" + image, [s, recorded, image](Backend& backend) {
                      return run_recorded(recorded, image, s, backend);
                    }});
  for (const NamedPhotograph& photograph : single_photographs(s.data, s.frames_every))
    list.push_back(
        {photograph.name, [s, photograph](Backend& backend) {
           KnownScene scene = photographed_scene(photograph.source);
           const Table around =
               run_trials(scene, starts_around(scene, s.starts, s.seed), trials(), s, backend);
           scene.set += BY_DISTANCE;
           return joined({around, run_trials(scene, starts_by_distance(scene, s.starts, s.seed),
                                             trials(), s, backend)});
         }});
  return list;
}

std::vector<Series> series_in(const Table& table) {
  std::vector<Series> list;
  for (const std::string& method : values_of(table, "method"))
    list.push_back({method, [method](const Table& t, std::size_t row) {
                      return text_in(t, row, "method") == method;
                    }});
  return list;
}

// Compares the paper's first two methods: with each lambda, with the original's smoothing, and each
// with its best lambda. The last comparison is the gain from the search.
std::vector<Comparison> comparisons() {
  std::vector<Comparison> list;
  for (const float lambda : {PAPER_LAMBDA_PX_PER_RAD, OWN_LAMBDA_PX_PER_RAD})
    list.emplace_back(Trial{"d2co", 1, lambda}.name(), Trial{"dc-icp", 1, lambda}.name());
  list.emplace_back(as_in_the_original().name(), "dc-icp");
  list.emplace_back(Trial{"d2co", 1, OWN_LAMBDA_PX_PER_RAD}.name(), "dc-icp");
  list.emplace_back("edgescout", Trial{"d2co", 1, OWN_LAMBDA_PX_PER_RAD}.name());
  return list;
}

Table rows_of_set(const Table& table, const std::string& set) {
  return rows_where(table,
                    [&](const Table& t, std::size_t row) { return text_in(t, row, "set") == set; });
}

// Returns the original implementation's results from the same starts, as rows of the same columns.
Table original_rows(const Table& ran, const fs::path& results) {
  std::set<std::string> starts;
  for (const std::string& start : values_of(ran, "start")) starts.insert(start);
  Table table{{}, ran.columns, {}};
  for (const RecordedResult& result : recorded_results(results)) {
    if (!starts.contains(std::to_string(result.start))) continue;
    std::vector<std::string> row(ran.columns.size());
    const auto set = [&](const char* column, const std::string& value) {
      row[ran.column(column)] = value;
    };
    set("set", "d2co-starts");
    set("image", result.image);
    set("instance", result.instance);
    set("start", std::to_string(result.start));
    set("distance_rad", number_text(LEVELS_RAD[result.level - 1]));
    set("method", "original " + result.method);
    set("views", "1");
    set("right", result.is_right ? "1" : "0");
    set("ms", number_text(result.cpu_ms));
    table.rows.push_back(std::move(row));
  }
  return table;
}

// Reports the original implementation's results, file by file. Missing files are named.
std::string original_text(const Table& ran, const fs::path& data) {
  std::string text;
  for (const auto& [name, what] :
       {std::pair{"all_methods_l6.csv", "as shipped (LSD edges, lambda 6)"},
        {"all_methods_l100.csv", "with lambda 100"},
        {"all_methods_l100_canny.csv", "with lambda 100 and Canny edges"},
        {"d2co_l6_full.csv", "as shipped, D2CO alone"},
        {"d2co_l100_full.csv", "with lambda 100, D2CO alone"},
        {"d2co_l100_canny_full.csv", "with lambda 100 and Canny edges, D2CO alone"}}) {
    const fs::path file = fs::path("d2co-starts/original_results") / name;
    if (!fs::exists(data / file)) {
      log(LogLevel::Warning,
          fmt::format("{} is missing: the report has nothing of the original implementation {}",
                      (data / file).string(), what));
      text +=
          fmt::format("\nThe original implementation {}: *skipped*, the data folder has no {}.\n",
                      what, file.generic_string());
    } else if (const Table original = original_rows(ran, data / file); !original.rows.empty()) {
      text += fmt::format(
          "\nThe original implementation {}, on those of the starts that it ran on:\n\n{}", what,
          rate_table(original, series_in(original), pose_criterion()));
    }
  }
  return text;
}

std::string recorded_text(const Table& ran, const ExperimentSettings& settings) {
  return "## Recorded starts (d2co-starts)\n\nStarts at exactly 0.1 rad / 5 mm, 0.2 / 10, 0.3 / "
         "15, "
         "0.4 / 20; correct is " +
         pose_criterion().text + ".\n\n" +
         rate_table(ran, series_in(ran), pose_criterion(), comparisons()) +
         original_text(ran, settings.data);
}

std::string by_distance_table(const Table& table, const Criterion& criterion) {
  std::string text = "| method | from 0.1 rad and 2 % of the distance |\n|---|---|\n";
  for (const Series& series : series_in(table)) {
    const std::vector<Cluster> clusters = rates_of(table, series, criterion).clusters[0];
    text += fmt::format("| {} | {} |\n", series.name,
                        percent(rate(clusters), bootstrap_interval(clusters)));
  }
  return text;
}

std::string steps_text(const Table& table, const std::string& method) {
  std::vector<double> steps;
  double cut_off = 0;
  for (std::size_t row = 0; row < table.rows.size(); ++row) {
    if (text_in(table, row, "method") != method) continue;
    steps.push_back(number_in(table, row, "steps"));
    cut_off += number_in(table, row, "cut_off");
  }
  const double share = cut_off / static_cast<double>(steps.size());
  return fmt::format("{:.0f} | {:.0f} %", median(std::move(steps)), 100 * share);
}

// Table 1 of the paper, on the rendered scenes.
std::string time_table(const Table& rendered, const BaselineOptions& limits) {
  constexpr std::pair<const char*, double> PAPER_MS[] = {
      {"d2co", 56.49}, {"dc-icp", 659.09}, {"lm-icp", 68.43}, {"c-icp", 601.10}, {"direct", 65.83}};
  std::string text =
      "| method | mean ms | times D2CO | paper, ms | times D2CO | median of steps | cut off at the "
      "limit "
      "|\n|---|---|---|---|---|---|---|\n";
  const auto times = [&](const std::string& method) {
    return rates_of(rendered,
                    {method, [&](const Table& t,
                                 std::size_t row) { return text_in(t, row, "method") == method; }},
                    pose_criterion())
        .ms;
  };
  const double own = mean(times("d2co"));
  if (own <= 0) return "";
  for (const std::string& method : values_of(rendered, "method")) {
    const std::vector<double> ms = times(method);
    const auto paper = std::ranges::find(
        PAPER_MS, method, [](const auto& entry) { return std::string(entry.first); });
    text += fmt::format(
        "| {} | {:.2f} | {:.1f} | {} | {} |\n", method, mean(ms), mean(ms) / own,
        paper == std::end(PAPER_MS)
            ? " | "
            : fmt::format("{:.0f} | {:.1f}", paper->second, paper->second / PAPER_MS[0].second),
        steps_text(rendered, method));
  }
  return fmt::format(
      "## Time of one registration\n\nOn a CPU one thread's own time; on a device the time that "
      "passes, and "
      "of "
      "the methods that only a CPU runs theirs on its threads. Tensors and distance transforms not "
      "included, "
      "rendered images. Steps are associations of the ICPs, which have at most {}; all others' of "
      "their one "
      "solve (Direct: of all levels; edgescout: of its edge ICP, which has a limit of its own), at "
      "most {}.\n\n"
      "{}\n",
      limits.outer_iterations, limits.inner_iterations, text);
}

Report report(const ExperimentSettings& settings, const Table& table) {
  Report result;
  const Table rendered = rows_of_set(table, "rendered");
  result.markdown = fmt::format(
      "## Rendered images\n\n{} images, {} starts around every instance of which at least a tenth "
      "shows; "
      "correct is {} modulo symmetry.\n\n{}\n{}",
      settings.scenes, settings.starts, pose_criterion().text,
      rate_table(rendered, series_in(table), pose_criterion(), comparisons()),
      time_table(rendered, settings.methods));
  result.panels.push_back(
      rate_panel("rendered, all types", rendered, series_in(table), pose_criterion()));
  for (const std::string& type : values_of(rendered, "object")) {
    const Table rows = rows_where(rendered, [&](const Table& t, std::size_t row) {
      return text_in(t, row, "object") == type;
    });
    result.panels.push_back(rate_panel(type, rows, series_in(table), pose_criterion()));
  }
  if (const Table recorded = rows_of_set(table, "d2co-starts"); !recorded.rows.empty()) {
    result.markdown += recorded_text(recorded, settings);
    result.panels.push_back(
        rate_panel("d2co-starts", recorded, series_in(table), pose_criterion()));
  }
  for (const char* set : {"brackets", "cat", "triangle"}) {
    const Table rows = rows_of_set(table, set);
    if (rows.rows.empty()) continue;
    const Criterion criterion = image_criterion();
    result.markdown += fmt::format(
        "\n## Photographs: {}\n\nCorrect is {}: what is known of the true poses. {}\n\n{}", set,
        criterion.text, PHOTOGRAPHS_COUNT_APART,
        rate_table(rows, series_in(table), criterion, comparisons()));
    result.markdown += fmt::format(
        "\n{}", by_distance_table(rows_of_set(table, set + std::string(BY_DISTANCE)), criterion));
    result.panels.push_back(
        rate_panel(fmt::format("{} ({})", set, criterion.text), rows, series_in(table), criterion));
  }
  return result;
}

}  // namespace

Experiment registration_experiment() {
  return {"registration", "Registration against the start's distance", options, cells, report};
}

}  // namespace edgescout
