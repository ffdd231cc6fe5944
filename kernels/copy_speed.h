// How fast a device copies memory: the floor under the time of every kernel that must read and
// write so many bytes.
#pragma once

#include <string>

namespace edgescout {

// Bytes read and written a second by the best of several copies of a block far larger than any
// cache: on the CPU by all threads together, on a Vulkan device by itself, in its own memory.
// `choice` as in make_backend (backend.h), which throws where there is no such device.
double copy_bytes_per_s(const std::string& choice);

}  // namespace edgescout
