// The Vulkan loader's instance and, where asked for, the validation layer (with synchronization
// validation).
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

// The process's instance, made when first asked for and never destroyed: with the last instance the
// loader unloads the drivers, and loading them again costs as much as a small image. Throws as the
// constructor does.
const Instance& shared_instance(bool validation);

}  // namespace edgescout::gpu
