// Errors of a message, apart from those of the device.
#pragma once

#include <exception>
#include <new>
#include <string>

#include "host/io/one_line.h"
#include "kernels/error.h"

namespace edgescout::ros2 {

// Whatever a message makes the library throw is an error of that message. A failed device is not.
template <typename Work, typename OnError>
void guarded(const Work& work, const OnError& on_error) {
  try {
    work();
  } catch (const GpuError&) {
    throw;
  } catch (const std::bad_alloc&) {
    on_error("found more than there is memory for, expected less");
  } catch (const std::exception& error) {
    on_error(one_line(error.what()));
  }
}

}  // namespace edgescout::ros2
