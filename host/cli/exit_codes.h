// The exit codes of the program. They are part of the interface: scripts rely on them.
#pragma once

namespace edgescout {

enum ExitCode : int {
  exit_done = 0,
  exit_some_failed = 1,  // finished; the summary lists what failed
  exit_bad_request =
      2,  // an option, file or device cannot be used; results of finished images stay
  exit_device_failed = 3,   // a Vulkan call failed; results of finished images are on disk
  exit_internal_error = 4,  // our own bug, or no memory left
};

}  // namespace edgescout
