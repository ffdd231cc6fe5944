#include "host/cli/progress.h"

#include <unistd.h>

#include <algorithm>

namespace edgescout {

namespace {
constexpr std::size_t bar_width = 30;
}

bool stderr_is_terminal() { return ::isatty(STDERR_FILENO) == 1; }

Progress::Progress(std::string title, std::size_t total, std::ostream& out, bool on_terminal,
                   std::size_t done_before)
    : title_(std::move(title)),
      total_(std::max<std::size_t>(total, 1)),
      out_(out),
      on_terminal_(on_terminal),
      done_before_(std::min(done_before, total_)) {
  if (on_terminal_) out_ << line() << std::flush;
}

Progress::~Progress() {
  if (on_terminal_) out_ << '\n' << std::flush;
}

void Progress::step(std::size_t count) {
  const std::lock_guard lock(mutex_);
  done_ = std::min(done_ + count, total_);
  draw();
}

void Progress::move_to(std::size_t done) {
  const std::lock_guard lock(mutex_);
  done_ = std::clamp(done, done_, total_);
  draw();
}

void Progress::draw() {
  const std::size_t parts = (on_terminal_ ? 100 : 10) * done_ / total_;
  if (parts == drawn_) return;
  drawn_ = parts;
  out_ << line() << (on_terminal_ ? "" : "\n") << std::flush;
}

std::string Progress::line() const {
  const std::string counts = std::to_string(done_) + "/" + std::to_string(total_);
  const double elapsed_s =
      std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count();
  std::string rest;
  if (done_ == total_)
    rest = ", took " + std::to_string(static_cast<long>(elapsed_s)) + " s";
  else if (done_ > done_before_)
    rest =
        ", " +
        std::to_string(static_cast<long>(elapsed_s * (total_ - done_) / (done_ - done_before_))) +
        " s left";
  if (!on_terminal_) return title_ + ": " + counts + rest;
  const std::size_t filled = bar_width * done_ / total_;
  // Goes to the start of the line, writes the text and clears the rest of an older, longer text.
  return "\r" + title_ + " [" + std::string(filled, '#') + std::string(bar_width - filled, '.') +
         "] " + counts + rest + "\x1b[K";
}

}  // namespace edgescout
