#include "kernels/gpu/extensions.h"

#include <algorithm>
#include <vector>

#include "kernels/gpu/result.h"

namespace edgescout::gpu {

namespace {

// `enumerate` is one of Vulkan's functions of that kind, asked for the count and then for as many.
template <class Enumerate>
bool is_among(const Enumerate& enumerate, const std::string& extension) {
  std::uint32_t count = 0;
  require(enumerate(&count, nullptr), "enumeration of extensions");
  std::vector<VkExtensionProperties> offered(count);
  require(enumerate(&count, offered.data()), "enumeration of extensions");
  offered.resize(count);
  return std::ranges::any_of(
      offered, [&](const VkExtensionProperties& one) { return one.extensionName == extension; });
}

}  // namespace

bool instance_offers(const std::string& extension) {
  return is_among(
      [](std::uint32_t* count, VkExtensionProperties* offered) {
        return vkEnumerateInstanceExtensionProperties(nullptr, count, offered);
      },
      extension);
}

bool device_offers(VkPhysicalDevice device, const std::string& extension) {
  return is_among(
      [device](std::uint32_t* count, VkExtensionProperties* offered) {
        return vkEnumerateDeviceExtensionProperties(device, nullptr, count, offered);
      },
      extension);
}

}  // namespace edgescout::gpu
