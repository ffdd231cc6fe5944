#include "host/experiments/experiment.h"

#include <fmt/format.h>

#include <algorithm>
#include <thread>

#include "host/experiments/detection.h"
#include "host/experiments/machine.h"
#include "host/experiments/multiview.h"
#include "host/experiments/nbv.h"
#include "host/experiments/registration.h"
#include "host/io/files.h"
#include "kernels/error.h"

namespace edgescout {

namespace fs = std::filesystem;

namespace {

// Cells on a CPU have one thread: their times are those of one thread, as in the paper.
std::unique_ptr<Backend> backend_of_cell(const std::string& device) {
  return device == "cpu" ? make_cpu_backend(1) : make_backend(device);
}

int workers_on(const std::string& device, int jobs) {
  if (device != "cpu") return 1;
  return jobs > 0 ? jobs : static_cast<int>(std::max(1u, std::thread::hardware_concurrency()));
}

Notes settings_notes(const Experiment& experiment, const ExperimentSettings& settings,
                     const std::string& device_name) {
  Notes notes{{"experiment", experiment.name},
              {"seed", std::to_string(settings.seed)},
              {"device", device_name}};
  for (const auto& note : experiment.options(settings)) notes.push_back(note);
  notes.emplace_back("times", settings.times ? "yes" : "no");
  if (settings.times) notes.emplace_back("machine", machine_name());  // times depend on the machine
  return notes;
}

// The cells may be older than the program that makes the report.
std::string provenance(const Table& table, const std::string& commit) {
  std::string text;
  bool same_commit = commit.empty();
  for (const auto& [name, value] : table.notes) {
    text += (text.empty() ? "" : "; ") + name + " " + value;
    same_commit = same_commit || (name == "commit" && value == commit);
  }
  return "Made with: " + text + (same_commit ? "" : "; this report by commit " + commit) + ".\n";
}

void write_report(const Experiment& experiment, const ExperimentSettings& settings,
                  const Table& table, const fs::path& out, const std::string& commit) {
  const Report report = experiment.report(settings, table);
  const std::string &name = experiment.name, made_with = provenance(table, commit);
  write_file_atomically(out / (name + ".csv"), to_csv(table));
  write_file_atomically(out / (name + ".svg"), svg_of(report.panels, report.columns, made_with));
  write_file_atomically(
      out / (name + ".md"),
      fmt::format("# {0}\n\n{1}\n![{0}]({2}.svg)\n\nRows: [{2}.csv]({2}.csv). {3}",
                  experiment.title, report.markdown, name, made_with));
}

// Lists every experiment that has a report, of this run or of an earlier one.
void write_index(const fs::path& out) {
  std::string text = "# Experiments\n\n";
  for (const Experiment& experiment : experiments())
    if (fs::exists(out / (experiment.name + ".md")))
      text += fmt::format("- [{0}]({1}.md), [plot]({1}.svg), [rows]({1}.csv)\n", experiment.title,
                          experiment.name);
  write_file_atomically(out / "index.md", text);
}

CellRun cell_run_of(const Experiment& experiment, const Notes& settings, const ExperimentRun& run,
                    const std::string& device_name) {
  CellRun cell_run;
  cell_run.folder = run.out / "cells" / experiment.name;
  cell_run.settings = settings;
  cell_run.commit = run.commit;
  cell_run.resume = run.resume;
  cell_run.any_commit = run.any_commit;
  cell_run.workers = workers_on(device_name, run.jobs);
  cell_run.make_backend = [device = run.device == "auto" && device_name == "cpu"
                                        ? "cpu"
                                        : run.device] { return backend_of_cell(device); };
  if (run.progress)
    cell_run.progress = [progress = run.progress, name = experiment.name](
                            std::size_t done, std::size_t all) { progress(name, done, all); };
  return cell_run;
}

}  // namespace

const std::vector<Experiment>& experiments() {
  static const std::vector<Experiment> all{detection_experiment(), registration_experiment(),
                                           multiview_experiment(), nbv_experiment()};
  return all;
}

std::vector<Experiment> experiments_named(const std::vector<std::string>& names) {
  if (names.empty()) return experiments();
  std::vector<Experiment> chosen;
  std::string known;
  for (const Experiment& experiment : experiments())
    known += (known.empty() ? "" : ", ") + experiment.name;
  for (const std::string& name : names) {
    const auto found = std::ranges::find(experiments(), name, &Experiment::name);
    if (found == experiments().end())
      throw InputError("experiments", "name", name, "one of " + known);
    if (std::ranges::count(names, name) > 1)
      throw InputError("experiments", "name", name + " twice", "each once");
    chosen.push_back(*found);
  }
  return chosen;
}

void run_experiments(const std::vector<Experiment>& chosen, const ExperimentSettings& settings,
                     const ExperimentRun& run) {
  settings.validate();
  if (!settings.data.empty() && !fs::is_directory(settings.data))
    throw InputError(settings.data.string(), "data", "no folder",
                     "one with d2co-starts, brackets, cat, triangle and cad");
  const std::string device_name = make_backend(run.device)->name();
  // All experiments are checked first: missing data or results of another run end the run before it
  // writes.
  std::vector<std::vector<Cell>> cells;
  std::vector<CellRun> runs;
  for (const Experiment& experiment : chosen) {
    cells.push_back(experiment.cells(settings));
    runs.push_back(cell_run_of(experiment, settings_notes(experiment, settings, device_name), run,
                               device_name));
    require_resumable(cells.back(), runs.back());
  }
  require_writable_folder(run.out);
  for (std::size_t i = 0; i < chosen.size(); ++i) {
    const Table table = joined(run_cells(cells[i], runs[i]));
    write_report(chosen[i], settings, table, run.out, run.commit);
    write_index(run.out);
  }
}

}  // namespace edgescout
