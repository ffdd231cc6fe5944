// The Vulkan loader's instance and, where asked for, the validation layer (with synchronization validation).
#pragma once

#include <vector>

#include <vulkan/vulkan.h>

namespace edgescout::gpu {

class Instance {
 public:
  // Throws GpuError where there is no driver, or no validation layer though one was asked for.
  explicit Instance(bool validation);
  ~Instance();
  Instance(const Instance&) = delete;
  Instance& operator=(const Instance&) = delete;

  VkInstance get() const { return instance_; }
  std::vector<VkPhysicalDevice> physical_devices() const;

 private:
  VkInstance instance_ = VK_NULL_HANDLE;
  VkDebugUtilsMessengerEXT messenger_ = VK_NULL_HANDLE;
};

}  // namespace edgescout::gpu
