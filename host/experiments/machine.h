// Describes the machine on which times are measured: its load and the memory that was used.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

namespace edgescout {

struct MachineLoad {
  int threads = 1;
  double load_average = 0;  // over the last minute; negative if the system does not tell
  // Fraction of the processors that this process gets when it uses all of them, [0, 1].
  double share = 1;
};

// Returns the system's name of the processor and its number of threads: "AMD EPYC 7B13 x 2".
// Contains no comma.
std::string machine_name();

// Uses all processors for a fifth of a second.
MachineLoad machine_load();
// Returns what may make times wrong: a load average above a quarter of the threads, a share below
// 0.9. Empty if there is nothing.
std::vector<std::string> warnings_of(const MachineLoad& load);
// The same at the end of a measurement, by the share alone: the load average then contains the
// measurement itself.
std::vector<std::string> warnings_at_end(const MachineLoad& load);

// peak_memory_bytes returns the peak resident memory of this process since the last successful
// forget_peak_memory(), else since its start; 0 if the system does not tell. forget_peak_memory
// returns false if the system cannot reset the peak.
bool forget_peak_memory();
std::size_t peak_memory_bytes();

}  // namespace edgescout
