// Another participant of DDS, and the program as a child process beside it. Both keep to the
// loopback interface and to a domain of this process.
#pragma once

#include <fcntl.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <functional>
#include <string>
#include <thread>
#include <vector>

#include "host/bridge/ros2/dds/dds_node.h"
#include "tests/io/temporary_folder.h"

namespace edgescout::ros2::test {

using edgescout::test::content_of;
using edgescout::test::TemporaryFolder;

// ROS_DOMAIN_ID of this process: tests beside each other do not meet.
inline std::uint32_t own_domain() { return 1 + std::uint32_t(::getpid()) % 200; }

// The program, until this is destroyed or stopped.
class RunningProgram {
 public:
  explicit RunningProgram(const std::vector<std::string>& arguments) {
    std::vector<char*> argv{const_cast<char*>(EDGESCOUT_ROS2_PROGRAM)};
    for (const std::string& word : arguments) argv.push_back(const_cast<char*>(word.c_str()));
    argv.push_back(nullptr);
    const std::string log_file = (folder_.path() / "log").string();
    const std::string domain = std::to_string(own_domain());  // of the parent
    child_ = ::fork();
    if (child_ != 0) return;
    ::setenv("ROS_DOMAIN_ID", domain.c_str(), 1);
    ::setenv("ROS_LOCALHOST_ONLY", "1", 1);
    ::setenv("XDG_CACHE_HOME", folder_.path().c_str(), 1);
    const int log = ::open(log_file.c_str(), O_WRONLY | O_CREAT, 0600);
    for (int stream : {1, 2}) ::dup2(log, stream);
    ::execv(EDGESCOUT_ROS2_PROGRAM, argv.data());
    ::_exit(127);
  }
  RunningProgram(const RunningProgram&) = delete;
  RunningProgram& operator=(const RunningProgram&) = delete;
  ~RunningProgram() {
    if (child_ > 0) ::kill(child_, SIGKILL), wait();
  }
  // Asks it to end. Its exit code; -1: it did not end by itself.
  int stop() {
    ::kill(child_, SIGTERM);
    return wait();
  }
  // Waits for its end.
  int wait() {
    int status = 0;
    const bool ended = ::waitpid(child_, &status, 0) == child_;
    child_ = -1;
    return ended && WIFEXITED(status) ? WEXITSTATUS(status) : -1;
  }
  bool is_running() const { return ::waitpid(child_, nullptr, WNOHANG) == 0; }
  pid_t process() const { return child_; }
  std::string log() const { return content_of(folder_.path() / "log"); }

 private:
  TemporaryFolder folder_;
  pid_t child_ = -1;
};

class Peer : public DdsNode {
 public:
  Peer() : DdsNode(own_domain(), true) {}

  // Handles messages until the condition holds. False: it does not within the time.
  bool spin_until(const std::function<bool()>& condition, double seconds = 60) {
    const auto end = std::chrono::steady_clock::now() + std::chrono::duration<double>(seconds);
    while (!condition()) {
      if (std::chrono::steady_clock::now() > end) return false;
      spin(0.02);
    }
    return true;
  }

  template <typename Wire, typename Plain>
  static bool write(const DdsWriter& writer, const Plain& plain) {
    Wire wire{};
    ToWire io;
    io(plain, wire);
    return writer.write(&wire);
  }
};

template <typename Plain, typename Wire>
Plain plain_of(const Wire& wire) {
  Plain plain;
  FromWire io;
  io(plain, wire);
  return plain;
}

}  // namespace edgescout::ros2::test
