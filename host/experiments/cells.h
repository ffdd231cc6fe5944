// Runs an experiment as cells: small units of work with a stable name.
//
// The result of a cell is a file as soon as the cell is finished. So a stopped run loses nothing,
// and a resumed run repeats nothing.
#pragma once

#include <filesystem>
#include <functional>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "host/experiments/table.h"
#include "kernels/backend.h"

namespace edgescout {

// `name` is the path of the file in the folder of cells, without extension: "rendered/scene_007".
// `run` may be called on any thread. Its result must not depend on the cells that ran before.
struct Cell {
  std::string name;
  std::function<Table(Backend&)> run;
};

struct CellRun {
  std::filesystem::path folder;  // of the cells' files
  Notes settings;                // the results depend on them; every file begins with them
  std::string commit;            // noted after the settings
  bool resume = false;
  bool any_commit = false;  // also accepts finished cells of other commits
  int workers = 1;          // number of cells that run in parallel, each with its own backend
  std::function<std::unique_ptr<Backend>()> make_backend;
  // May be empty. Called at the start and after every cell, by one thread at a time.
  std::function<void(std::size_t done, std::size_t all)> progress;
};

// Returns the tables of the cells, in their order. With `resume` the file of a finished cell is
// used as it is; a file that cannot be read is made again. Finished cells stay, whatever ends the
// run. InputError: a finished cell without `resume`; a finished cell with other settings (names the
// first that differs), with other columns, or of another commit without `any_commit`; a file that
// cannot be written.
std::vector<Table> run_cells(std::span<const Cell> cells, const CellRun& run);

// Throws the InputError that run_cells would throw for finished cells, without running a cell.
void require_resumable(std::span<const Cell> cells, const CellRun& run);

}  // namespace edgescout
