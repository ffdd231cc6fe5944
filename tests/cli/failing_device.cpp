// A Vulkan device that is lost or full: preloaded before the loader, it lets FAIL_AFTER_SUBMITS
// submissions pass and fails every one after them, and has no memory for more than FREE_BYTES at
// once, where that is set. How many submissions were asked for is left in SUBMITS_FILE.
#include <dlfcn.h>
#include <vulkan/vulkan.h>

#include <atomic>
#include <cstdio>
#include <cstdlib>

namespace {

template <class Function>
Function function_of_loader(const char* name) {
  // RTLD_NEXT is a number that dlsym knows: NOLINTNEXTLINE(performance-no-int-to-ptr)
  return reinterpret_cast<Function>(dlsym(RTLD_NEXT, name));
}

}  // namespace

extern "C" VkResult vkQueueSubmit(VkQueue queue, std::uint32_t count, const VkSubmitInfo* submits,
                                  VkFence fence) {
  static std::atomic<int> asked{0};
  static const int limit = std::atoi(std::getenv("FAIL_AFTER_SUBMITS"));
  static const auto submit = function_of_loader<PFN_vkQueueSubmit>("vkQueueSubmit");
  const int number = ++asked;
  if (std::FILE* file = std::fopen(std::getenv("SUBMITS_FILE"), "w")) {
    std::fprintf(file, "%d", number);
    std::fclose(file);
  }
  return number <= limit ? submit(queue, count, submits, fence) : VK_ERROR_DEVICE_LOST;
}

extern "C" VkResult vkAllocateMemory(VkDevice device, const VkMemoryAllocateInfo* info,
                                     const VkAllocationCallbacks* callbacks,
                                     VkDeviceMemory* memory) {
  static const char* free_bytes = std::getenv("FREE_BYTES");
  static const auto allocate = function_of_loader<PFN_vkAllocateMemory>("vkAllocateMemory");
  if (free_bytes && info->allocationSize > std::strtoull(free_bytes, nullptr, 10))
    return VK_ERROR_OUT_OF_DEVICE_MEMORY;
  return allocate(device, info, callbacks, memory);
}
