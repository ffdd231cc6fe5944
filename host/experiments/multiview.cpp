#include "host/experiments/multiview.h"

#include <fmt/format.h>

#include <algorithm>

#include "host/experiments/data_mark.h"
#include "host/experiments/photographs.h"
#include "host/experiments/rates.h"
#include "host/experiments/recorded_starts.h"
#include "host/experiments/trials.h"

namespace edgescout {

namespace fs = std::filesystem;

namespace {

constexpr int VIEWS = 3;  // the first and N_v = 2 more

// More recorded starts are used than for one view, and more starts on the only pile of photographs,
// since few images have other views.
int recorded_every(const ExperimentSettings& s) { return (s.every + 2) / 3; }
int pile_starts(const ExperimentSettings& s) { return 5 * s.group_starts; }

std::vector<Trial> trials() {
  return {{"d2co", 1},
          {"d2co", VIEWS},
          {"d2co", 1, OWN_LAMBDA_PX_PER_RAD},
          {"d2co", VIEWS, OWN_LAMBDA_PX_PER_RAD},
          {"edgescout", 1},
          {"edgescout", VIEWS}};
}

Notes options(const ExperimentSettings& s) {
  Notes notes{{"groups", std::to_string(s.groups)},
              {"group_starts", std::to_string(s.group_starts)},
              {"image_scale", number_text(s.image_scale)},
              {"supersampling", std::to_string(s.supersampling)}};
  std::ranges::copy(trial_notes(s), std::back_inserter(notes));
  if (s.data.empty()) return notes;
  notes.emplace_back("data", data_mark(s.data));
  notes.emplace_back("every", std::to_string(recorded_every(s)));
  notes.emplace_back("pile_starts", std::to_string(pile_starts(s)));
  return notes;
}

Table run_recorded(const fs::path& folder, const std::string& image,
                   const ExperimentSettings& settings, Backend& backend) {
  const KnownScene scene = recorded_scene(folder, image, VIEWS - 1);
  return run_trials(scene, as_starts(recorded_starts(folder, scene, recorded_every(settings))),
                    trials(), settings, backend);
}

std::vector<Cell> cells(const ExperimentSettings& s) {
  std::vector<Cell> list;
  for (int number = 0; number < s.groups; ++number) {
    const std::string name = fmt::format("group_{:03}", number);
    list.push_back({"rendered/" + name, [s, number, name](Backend& backend) {
                      const KnownScene scene =
                          rendered_scene(name, rendered_types(), image_group_options(s, number),
                                         backend.threads());
                      return run_trials(scene, starts_around(scene, s.group_starts, s.seed),
                                        trials(), s, backend);
                    }});
  }
  if (s.data.empty()) return list;
  const fs::path recorded = s.data / "d2co-starts";
  for (const std::string& image : recorded_images(recorded))
    if (other_views(recorded, image) >= VIEWS - 1)
      list.push_back({"d2co-starts/" + image, [s, recorded, image](Backend& backend) {
                        return run_recorded(recorded, image, s, backend);
                      }});
  const Photographs pile = photographs_in(s.data, s.frames_every)[0];
  list.push_back({"brackets/pile", [s, pile](Backend& backend) {
                    const KnownScene scene = photographed_scene(pile);
                    return run_trials(scene, starts_around(scene, pile_starts(s), s.seed), trials(),
                                      s, backend);
                  }});
  return list;
}

std::string name_of(const Trial& trial) {
  return fmt::format("{}, {}", trial.name(),
                     trial.views == 1 ? "one view" : fmt::format("{} views", trial.views));
}

// Compares three views with one for every method, and for D2CO the paper's lambda with edgescout's.
std::vector<Comparison> comparisons() {
  std::vector<Comparison> list;
  for (const Trial& several : trials()) {
    if (several.views == 1) continue;
    Trial single = several;
    single.views = 1;
    list.emplace_back(name_of(several), name_of(single));
  }
  list.emplace_back(name_of({"d2co", VIEWS, PAPER_LAMBDA_PX_PER_RAD}),
                    name_of({"d2co", VIEWS, OWN_LAMBDA_PX_PER_RAD}));
  return list;
}

std::vector<Series> series() {
  std::vector<Series> list;
  for (const Trial& trial : trials())
    list.push_back({name_of(trial), [trial](const Table& table, std::size_t row) {
                      return text_in(table, row, "method") == trial.name() &&
                             text_in(table, row, "views") == std::to_string(trial.views);
                    }});
  return list;
}

Report report(const ExperimentSettings& settings, const Table& table) {
  Report result;
  result.markdown = fmt::format(
      "The first image of three alone, and all three together. Rendered: {} groups of up to twenty "
      "parts, {} "
      "starts around every instance of which at least a tenth shows in the first image; correct "
      "modulo "
      "symmetry.\n\n",
      settings.groups, settings.group_starts);
  const auto rows_of = [&](const std::function<bool(const Table&, std::size_t)>& fits) {
    return rows_where(table, fits);
  };
  const auto add = [&](const std::string& title, const Table& rows, const Criterion& criterion) {
    if (rows.rows.empty()) return;
    result.markdown += fmt::format("## {}\n\nCorrect is {}.\n\n{}\n", title, criterion.text,
                                   rate_table(rows, series(), criterion, comparisons()));
    result.panels.push_back(rate_panel(title, rows, series(), criterion));
  };
  const auto is_rendered = [](const Table& t, std::size_t row) {
    return text_in(t, row, "set") == "rendered";
  };
  const auto is_light = [](const Table& t, std::size_t row) {
    return number_in(t, row, "visible") > LIGHTLY_OCCLUDED;
  };
  add("Rendered groups", rows_of(is_rendered), pose_criterion());
  add("Rendered groups, lightly occluded", rows_of([&](const Table& t, std::size_t row) {
        return is_rendered(t, row) && is_light(t, row);
      }),
      pose_criterion());
  add("Rendered groups, highly occluded", rows_of([&](const Table& t, std::size_t row) {
        return is_rendered(t, row) && !is_light(t, row);
      }),
      pose_criterion());
  for (const auto& [set, criterion] :
       {std::pair{"d2co-starts", pose_criterion()}, {"brackets", image_criterion()}})
    add(fmt::format("{} ({})", set,
                    set == std::string("brackets") ? "photographs of a pile" : "recorded starts"),
        rows_of([&](const Table& t, std::size_t row) { return text_in(t, row, "set") == set; }),
        criterion);
  return result;
}

}  // namespace

Experiment multiview_experiment() {
  return {"multiview", "One view against three", options, cells, report};
}

}  // namespace edgescout
