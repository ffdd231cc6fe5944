// The Vulkan backend with every option of its device; make_vulkan_backend() is the usual way in.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "kernels/backend.h"
#include "kernels/gpu/device_options.h"

namespace edgescout::gpu {

std::unique_ptr<Backend> make_backend(const DeviceOptions& options);

// Every warning and error of the validation layer since the last call, from all devices of the
// process: they report what they leak while they are being destroyed, so the list outlives them.
std::vector<std::string> take_validation_messages();

}  // namespace edgescout::gpu
