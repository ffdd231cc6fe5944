// The machine that something is timed on: how busy it is, what memory was needed.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

namespace edgescout {

struct MachineLoad {
  int threads = 1;
  double load_average = 0;  // over the last minute; negative where the system does not tell
  double share =
      1;  // of the processors that this process gets when it asks for all of them, [0, 1]
};

// The processor as the system names it, and how many threads it runs: "AMD EPYC 7B13 x 2". No
// comma.
std::string machine_name();

// Takes a fifth of a second of all processors.
MachineLoad machine_load();
// What may spoil times; empty where nothing does: a load average above a quarter of the threads, a
// share below 0.9.
std::vector<std::string> warnings_of(const MachineLoad& load);
// The same at the end of a measurement, by the share alone: the load average is then the
// measurement's own.
std::vector<std::string> warnings_at_end(const MachineLoad& load);

// Peak resident memory of this process since the last call of forget_peak_memory() that was true
// (false: the system cannot forget), else since its start. 0 where the system does not tell.
bool forget_peak_memory();
std::size_t peak_memory_bytes();

}  // namespace edgescout
