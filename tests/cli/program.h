// Runs the built program and keeps its output.
#pragma once

#include <fcntl.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <cstdlib>
#include <functional>
#include <string>
#include <thread>
#include <vector>

#include "tests/io/temporary_folder.h"

namespace edgescout::test {

struct Outcome {
  int exit_code = -1;  // -1: killed by a signal
  std::string out;
  std::string err;
};

// `environment` stands before the program, as in a shell: "NAME=value". The programs of one test
// program keep templates in one folder: each set is built once. The user's is neither read nor
// written.
Outcome run_program(const std::vector<std::string>& arguments, const std::string& environment = "");

// Leaves it running, from its file.
inline pid_t start_program(const std::vector<std::string>& arguments) {
  std::vector<char*> argv{const_cast<char*>(EDGESCOUT_CLI)};
  for (const std::string& argument : arguments) argv.push_back(const_cast<char*>(argument.c_str()));
  argv.push_back(nullptr);
  const pid_t child = ::fork();
  if (child != 0) return child;
  const int nowhere = ::open("/dev/null", O_RDWR);
  for (int stream : {0, 1, 2}) ::dup2(nowhere, stream);
  ::execv(EDGESCOUT_CLI, argv.data());
  ::_exit(127);
}

// Starts the program and kills it as soon as `condition` holds, however long that takes (sanitizers
// are slow, the test's own time limit ends a wait in vain). False where it had ended before.
inline bool run_program_until(const std::vector<std::string>& arguments,
                              const std::function<bool()>& condition) {
  const pid_t child = start_program(arguments);
  if (child < 0) return false;
  int status = 0;
  while (!condition()) {
    if (::waitpid(child, &status, WNOHANG) != 0) return false;
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
  ::kill(child, SIGKILL);
  return ::waitpid(child, &status, 0) == child && WIFSIGNALED(status);
}

// One line that starts with the program's name.
inline bool is_one_line_error(const std::string& err) {
  return err.starts_with("edgescout: error: ") && err.find('\n') == err.size() - 1;
}

}  // namespace edgescout::test
