// Shows the progress of a long job: as a bar on a terminal, otherwise as one line per tenth.
#pragma once

#include <chrono>
#include <mutex>
#include <ostream>
#include <string>

namespace edgescout {

// Returns whether standard error is a terminal.
bool stderr_is_terminal();

// Its functions may be called from several threads.
class Progress {
 public:
  // `done_before`: the part that an earlier run finished. It does not count for the remaining time.
  Progress(std::string title, std::size_t total, std::ostream& out, bool on_terminal,
           std::size_t done_before = 0);
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;
  ~Progress();  // ends the bar's line

  void step(std::size_t count = 1);
  void move_to(std::size_t done);  // a smaller value is ignored

 private:
  void draw();
  std::string line() const;

  const std::string title_;
  const std::size_t total_;
  std::ostream& out_;
  const bool on_terminal_;
  const std::size_t done_before_;
  const std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
  std::mutex mutex_;
  std::size_t done_ = done_before_;
  std::size_t drawn_ = 0;  // hundredths on a terminal, tenths otherwise
};

}  // namespace edgescout
