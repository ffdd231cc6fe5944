#include "host/experiments/machine.h"

#include <fmt/format.h>
#include <stdlib.h>
#include <time.h>

#include <algorithm>
#include <chrono>
#include <fstream>
#include <thread>

namespace edgescout {

namespace {

using Clock = std::chrono::steady_clock;

constexpr double LEAST_SHARE = 0.9;  // of the processors; below it times are unreliable

double own_seconds() {
  timespec time{};
  ::clock_gettime(CLOCK_THREAD_CPUTIME_ID, &time);
  return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
}

// Returns the fraction of the wall-clock time that a thread gets which never waits.
double share_of_one(Clock::duration length) {
  const Clock::time_point begin = Clock::now();
  const double own = own_seconds();
  while (Clock::now() - begin < length) {
  }
  return (own_seconds() - own) / std::chrono::duration<double>(Clock::now() - begin).count();
}

std::string processor_name() {
  std::ifstream info("/proc/cpuinfo");
  for (std::string line; std::getline(info, line);)
    if (line.starts_with("model name"))
      if (const std::size_t at = line.find(": "); at != std::string::npos)
        return line.substr(at + 2);
  return "unknown processor";
}

}  // namespace

std::string machine_name() {
  std::string name = processor_name();
  std::ranges::replace(name, ',', ' ');
  return fmt::format("{} x {}", name, std::thread::hardware_concurrency());
}

MachineLoad machine_load() {
  constexpr std::chrono::milliseconds LENGTH{200};
  MachineLoad load;
  load.threads = static_cast<int>(std::max(1u, std::thread::hardware_concurrency()));
  double average = 0;
  load.load_average = ::getloadavg(&average, 1) == 1 ? average : -1;
  std::vector<double> shares(static_cast<std::size_t>(load.threads));
  {
    std::vector<std::jthread> threads;
    for (double& share : shares)
      threads.emplace_back([&share, LENGTH] { share = share_of_one(LENGTH); });
  }
  load.share = 0;
  for (const double share : shares) load.share += share / load.threads;
  return load;
}

std::vector<std::string> warnings_of(const MachineLoad& load) {
  constexpr double MOST_LOAD = 0.25;
  std::vector<std::string> warnings;
  if (load.load_average > MOST_LOAD * load.threads)
    warnings.push_back(fmt::format("the machine is busy: load average {:.2f} on {} threads",
                                   load.load_average, load.threads));
  if (load.share < LEAST_SHARE)
    warnings.push_back(fmt::format(
        "the machine is busy: only {:.0f} % of its processors are to be had", 100 * load.share));
  return warnings;
}

std::vector<std::string> warnings_at_end(const MachineLoad& load) {
  if (load.share >= LEAST_SHARE) return {};
  return {
      fmt::format("the machine was busy at the end: only {:.0f} % of its processors were to be had",
                  100 * load.share)};
}

bool forget_peak_memory() {
  std::ofstream file("/proc/self/clear_refs");
  file << "5" << std::flush;
  return file.good();
}

std::size_t peak_memory_bytes() {
  std::ifstream status("/proc/self/status");
  for (std::string word; status >> word;)
    if (std::size_t kib = 0; word == "VmHWM:" && status >> kib) return 1024 * kib;
  return 0;
}

}  // namespace edgescout
