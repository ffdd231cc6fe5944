// The Vulkan loader's instance and, where asked for, the validation layer (with synchronization validation).
#pragma once

#include <string>
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

// Every warning and error of the validation layer since the last call, from all instances of the process:
// devices report what they leak while they are being destroyed, so the list outlives them.
std::vector<std::string> take_validation_messages();

}  // namespace edgescout::gpu
