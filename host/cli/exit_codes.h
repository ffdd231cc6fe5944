// What the program's exit status says. Part of the interface: scripts rely on it.
#pragma once

namespace edgescout {

enum ExitCode : int {
  exit_done = 0,
  exit_some_failed = 1,     // finished; the summary lists what failed
  exit_bad_request = 2,     // option, file or device asked for cannot be used; finished images stay
  exit_device_failed = 3,   // a Vulkan call failed; results of finished images are on disk
  exit_internal_error = 4,  // our own bug, or no memory left
};

}  // namespace edgescout
