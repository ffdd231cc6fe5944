// What a physical device says about itself.
#pragma once

#include <vulkan/vulkan.h>

#include "kernels/backend.h"

namespace edgescout::gpu {

DeviceInfo describe(VkPhysicalDevice device, int index);

}  // namespace edgescout::gpu
