// The experiments of the paper (Sec. 6): each has cells to run and a report of their results.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "host/experiments/cells.h"
#include "host/experiments/plot.h"
#include "host/experiments/settings.h"

namespace edgescout {

struct Report {
  std::string markdown;  // tables with explanations, in the form of docs/evaluation.md
  std::vector<Panel> panels;
  int columns = 3;  // of panels
};

struct Experiment {
  std::string name, title;
  // What its results depend on, apart from seed, device and commit.
  Notes (*options)(const ExperimentSettings&);
  std::vector<Cell> (*cells)(const ExperimentSettings&);
  Report (*report)(const ExperimentSettings&, const Table&);  // of the rows of all cells
};

// In the paper's order.
const std::vector<Experiment>& experiments();
// No names: all experiments. InputError listing the known names: an unknown name.
std::vector<Experiment> experiments_named(const std::vector<std::string>& names);

struct ExperimentRun {
  std::filesystem::path out;
  std::string device = "cpu";  // as make_backend takes it
  std::string commit;
  bool resume = false;
  bool any_commit = false;  // also accepts finished cells of other commits
  int jobs = 0;             // cells in parallel on a CPU; 0: as many as it has threads
  // May be empty.
  std::function<void(const std::string& experiment, std::size_t done, std::size_t all)> progress;
};

// Writes into `out`: cells/NAME/.. and, when all cells of an experiment are finished, NAME.csv (all
// rows), NAME.md, NAME.svg and index.md. On a CPU `jobs` cells run in parallel, each on one thread.
// On a device the cells run one after the other. InputError as run_cells. Settings out of bounds
// and missing data are reported before anything is written.
void run_experiments(const std::vector<Experiment>& chosen, const ExperimentSettings& settings,
                     const ExperimentRun& run);

}  // namespace edgescout
