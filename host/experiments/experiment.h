// The experiments of the paper (Sec. 6), each as cells to run and a report of what they gave.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "host/experiments/cells.h"
#include "host/experiments/plot.h"
#include "host/experiments/settings.h"

namespace edgescout {

struct Report {
  std::string markdown;  // tables and what they count, in the form of docs/evaluation.md
  std::vector<Panel> panels;
  int columns = 3;  // of panels
};

struct Experiment {
  std::string name, title;
  Notes (*options)(
      const ExperimentSettings&);  // what its results depend on, beside seed, device and commit
  std::vector<Cell> (*cells)(const ExperimentSettings&);
  Report (*report)(const ExperimentSettings&, const Table&);  // of the rows of all cells
};

// In the paper's order.
const std::vector<Experiment>& experiments();
// InputError listing the names there are on another one. No names: all of them.
std::vector<Experiment> experiments_named(const std::vector<std::string>& names);

struct ExperimentRun {
  std::filesystem::path out;
  std::string device = "cpu";  // as make_backend takes it
  std::string commit;
  bool resume = false;
  bool any_commit = false;  // finished cells of other commits are taken too
  int jobs = 0;             // cells side by side on a CPU; 0: as many as it has threads
  // may be empty
  std::function<void(const std::string& experiment, std::size_t done, std::size_t all)> progress;
};

// Writes into `out`: cells/NAME/.., and when the experiment's cells are finished NAME.csv (all
// rows), NAME.md, NAME.svg; at the end index.md. On a CPU `jobs` cells run side by side, each on
// one thread; on a device one after the other. InputError as run_cells; for settings out of bounds
// and for data that is not there before anything is written.
void run_experiments(const std::vector<Experiment>& chosen, const ExperimentSettings& settings,
                     const ExperimentRun& run);

}  // namespace edgescout
