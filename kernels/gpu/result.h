// What a Vulkan call answered, in words.
#pragma once

#include <string>

#include <vulkan/vulkan.h>

namespace edgescout::gpu {

// "VK_ERROR_DEVICE_LOST", or the number where the name is not known.
std::string result_name(VkResult result);

// Throws GpuError "CALL: VK_ERROR_..." unless `result` is VK_SUCCESS.
void require(VkResult result, const std::string& call);

}  // namespace edgescout::gpu
