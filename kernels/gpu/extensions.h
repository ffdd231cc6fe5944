// Which extensions there are.
#pragma once

#include <string>

#include <vulkan/vulkan.h>

namespace edgescout::gpu {

bool instance_offers(const std::string& extension);
bool device_offers(VkPhysicalDevice device, const std::string& extension);

}  // namespace edgescout::gpu
