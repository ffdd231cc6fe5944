#include "host/experiments/cells.h"

#include <algorithm>
#include <atomic>
#include <exception>
#include <mutex>
#include <optional>
#include <thread>

#include "host/core/log.h"
#include "host/core/option_names.h"
#include "host/io/files.h"
#include "kernels/error.h"

namespace edgescout {

namespace fs = std::filesystem;

namespace {

constexpr const char* COMMIT = "commit";

fs::path file_of(const Cell& cell, const CellRun& run) { return run.folder / (cell.name + ".csv"); }

void require_same_settings(const Table& finished, const CellRun& run, const std::string& file) {
  const auto fail = [&](const std::string& name, const std::string& found,
                        const std::string& expected) {
    throw InputError(file, name, found, expected + " as in this run, or another output folder");
  };
  for (const auto& [name, value] : run.settings) {
    const auto note =
        std::ranges::find(finished.notes, name, &std::pair<std::string, std::string>::first);
    if (note == finished.notes.end()) fail(name, "nothing", value);
    if (note->second != value) fail(name, note->second, value);
  }
  for (const auto& [name, value] : finished.notes)
    if (name != COMMIT &&
        std::ranges::find(run.settings, name, &std::pair<std::string, std::string>::first) ==
            run.settings.end())
      fail(name, value, "nothing");
  const auto commit =
      std::ranges::find(finished.notes, COMMIT, &std::pair<std::string, std::string>::first);
  if (commit == finished.notes.end()) fail(COMMIT, "nothing", run.commit);
  if (commit->second != run.commit && !run.any_commit)
    throw InputError(file, COMMIT, commit->second,
                     run.commit + " as in this run, " + option_name("any-commit") +
                         ", or another output folder");
}

// Returns the table that an earlier run left of a cell. A damaged file is made again; with `warn`
// that is logged.
std::optional<Table> finished_cell(const Cell& cell, const CellRun& run, bool warn) {
  const fs::path file = file_of(cell, run);
  if (!fs::exists(file)) return std::nullopt;
  if (!run.resume)
    throw InputError(file.string(), "finished cell", "one of an earlier run",
                     option_name("resume") + " or another output folder");
  Table table;
  try {
    table = load_table(file);
  } catch (const InputError& error) {
    if (warn) log(LogLevel::Warning, std::string(error.what()) + "; done again");
    return std::nullopt;
  }
  require_same_settings(table, run, file.string());
  return table;
}

// Cells of another commit may have other columns.
void require_same_columns(std::span<const Cell> cells, const CellRun& run,
                          const std::vector<std::optional<Table>>& tables, const Table& table) {
  for (std::size_t i = 0; i < cells.size(); ++i)
    if (tables[i] && tables[i]->columns != table.columns)
      throw InputError(file_of(cells[i], run).string(), "columns",
                       "others than those of other cells",
                       "cells of one program, or another output folder");
}

// Runs the open cells one after the other until none is left or one failed.
class Workers {
 public:
  Workers(std::span<const Cell> cells, const CellRun& run,
          std::vector<std::optional<Table>>& tables)
      : cells_(cells), run_(run), tables_(tables) {
    for (std::size_t i = 0; i < cells.size(); ++i)
      if (!tables[i]) open_.push_back(i);
    done_ = cells.size() - open_.size();
  }

  void work() {
    if (run_.progress) run_.progress(done_, cells_.size());
    std::vector<std::jthread> threads;
    const int count = std::min<int>(run_.workers, static_cast<int>(open_.size()));
    for (int i = 1; i < count; ++i) threads.emplace_back([this] { work_alone(); });
    if (count > 0) work_alone();
    threads.clear();
    if (failure_) std::rethrow_exception(failure_);
  }

 private:
  void work_alone() {
    try {
      const std::unique_ptr<Backend> backend = run_.make_backend();
      for (std::size_t next = next_++; next < open_.size() && !failed_; next = next_++)
        finish(open_[next], *backend);
    } catch (...) {
      const std::lock_guard lock(mutex_);
      failed_ = true;
      if (!failure_) failure_ = std::current_exception();
    }
  }

  void finish(std::size_t index, Backend& backend) {
    const Cell& cell = cells_[index];
    Table table = cell.run(backend);
    table.notes = run_.settings;
    table.notes.emplace_back(COMMIT, run_.commit);
    const fs::path file = file_of(cell, run_);
    {
      const std::lock_guard lock(mutex_);
      require_same_columns(cells_, run_, tables_, table);
    }
    require_writable_folder(file.parent_path());
    write_file_atomically(file, to_csv(table));
    const std::lock_guard lock(mutex_);
    tables_[index] = std::move(table);
    if (run_.progress) run_.progress(++done_, cells_.size());
  }

  std::span<const Cell> cells_;
  const CellRun& run_;
  std::vector<std::optional<Table>>& tables_;
  std::vector<std::size_t> open_;
  std::atomic<std::size_t> next_{0};
  std::atomic<bool> failed_{false};
  std::mutex mutex_;
  std::size_t done_ = 0;
  std::exception_ptr failure_;
};

}  // namespace

void require_resumable(std::span<const Cell> cells, const CellRun& run) {
  for (const Cell& cell : cells) finished_cell(cell, run, false);
}

std::vector<Table> run_cells(std::span<const Cell> cells, const CellRun& run) {
  std::vector<std::optional<Table>> tables;
  for (const Cell& cell : cells) tables.push_back(finished_cell(cell, run, true));
  for (const std::optional<Table>& table : tables)
    if (table) require_same_columns(cells, run, tables, *table);
  require_writable_folder(run.folder);
  Workers(cells, run, tables).work();
  std::vector<Table> results;
  for (std::optional<Table>& table : tables) results.push_back(std::move(*table));
  return results;
}

}  // namespace edgescout
