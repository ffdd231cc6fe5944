// How a device is opened.
#pragma once

#include <cstdint>

namespace edgescout::gpu {

struct DeviceOptions {
  int index = 0;              // as vulkan_devices() counts
  bool validation = false;    // validation layer with synchronization validation
  bool time_kernels = false;  // two timestamps a dispatch, each of which waits for all before it
  // for tests: a device whose memory the host does not cache: staged copies, as on a discrete card
  bool staging = false;
  // for tests: the shape of kernels is that on hardware which runs so many invocations in step; 0:
  // as it is
  std::uint32_t as_hardware = 0;
  // for tests: cut what can be cut as if the device bound no more at once; 0: as it is
  std::uint64_t max_band_bytes = 0;
};

}  // namespace edgescout::gpu
