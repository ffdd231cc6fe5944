// What is timed: every kernel through the Backend, on synthetic input that is the same on every
// device.
#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "kernels/backend.h"

namespace edgescout::bench {

// One call of `run` is one repetition; `bytes` is what it must read and write at least, for
// comparison with the memory's speed.
struct Case {
  std::string kernel;
  std::string size;
  std::size_t bytes;
  std::function<void()> run;
};

enum class Size { full, small };  // small: what the plain reference does in a moment, too

// Prepares the cases on a backend, which must outlive them.
std::vector<Case> make_cases(Backend& backend, Size size);

}  // namespace edgescout::bench
