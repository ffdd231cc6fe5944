// An experiment cut into cells: small units of work with a stable name, each a file as soon as it
// is finished, so that stopping loses nothing and resuming does nothing twice.
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

// `name` is the file's path below the folder of cells, without extension: "rendered/scene_007".
// `run` may be called on any thread; its result must not depend on which cells ran before.
struct Cell {
  std::string name;
  std::function<Table(Backend&)> run;
};

struct CellRun {
  std::filesystem::path folder;  // of the cells' files
  Notes settings;                // what the results depend on; the head of every file
  std::string commit;            // noted beside the settings
  bool resume = false;
  bool any_commit = false;  // finished cells of other commits are taken too
  int workers = 1;          // cells that run side by side, each with a backend of its own
  std::function<std::unique_ptr<Backend>()> make_backend;
  // may be empty; at the start too, by one thread at a time
  std::function<void(std::size_t done, std::size_t all)> progress;
};

// The cells' tables, in their order. A finished cell's file is taken as it is with `resume`; one
// that cannot be read is done again. InputError: finished cells without `resume`; a finished cell
// with other settings, naming the first that differs, of another commit without `any_commit`, or
// with other columns; a file that cannot be written. Whatever ends the run, finished cells stay.
std::vector<Table> run_cells(std::span<const Cell> cells, const CellRun& run);

// InputError where run_cells would throw one for finished cells, without running any.
void require_resumable(std::span<const Cell> cells, const CellRun& run);

}  // namespace edgescout
