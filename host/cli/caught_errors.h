// What a program does with the exceptions that reach its end.
#pragma once

#include <functional>
#include <string>

#include "host/cli/exit_codes.h"

namespace edgescout {

// Says an error and returns its code.
using Fail = std::function<int(const std::string& message, ExitCode code)>;

// The exit code of `run`, or that of `fail` with what it throws.
int with_caught_errors(const std::function<int()>& run, const Fail& fail);

}  // namespace edgescout
