// A Vulkan device that is lost: preloaded before the loader, it lets FAIL_AFTER_SUBMITS submissions pass and
// fails every one after them. How many were asked for is left in SUBMITS_FILE.
#include <dlfcn.h>
#include <vulkan/vulkan.h>

#include <atomic>
#include <cstdio>
#include <cstdlib>

extern "C" VkResult vkQueueSubmit(VkQueue queue, std::uint32_t count, const VkSubmitInfo* submits,
                                  VkFence fence) {
  static std::atomic<int> asked{0};
  static const int limit = std::atoi(std::getenv("FAIL_AFTER_SUBMITS"));
  static const auto submit = reinterpret_cast<PFN_vkQueueSubmit>(dlsym(RTLD_NEXT, "vkQueueSubmit"));
  const int number = ++asked;
  if (std::FILE* file = std::fopen(std::getenv("SUBMITS_FILE"), "w")) {
    std::fprintf(file, "%d", number);
    std::fclose(file);
  }
  return number <= limit ? submit(queue, count, submits, fence) : VK_ERROR_DEVICE_LOST;
}
