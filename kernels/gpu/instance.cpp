#include "kernels/gpu/instance.h"

#include <mutex>
#include <utility>

#include "kernels/gpu/extensions.h"
#include "kernels/gpu/result.h"
#include "kernels/gpu/vulkan_backend.h"

namespace edgescout::gpu {

namespace {

struct MessageLog {
  std::mutex mutex;
  std::vector<std::string> messages;
};
MessageLog& message_log() {
  static MessageLog log;
  return log;
}

VKAPI_ATTR VkBool32 VKAPI_CALL on_message(VkDebugUtilsMessageSeverityFlagBitsEXT,
                                          VkDebugUtilsMessageTypeFlagsEXT,
                                          const VkDebugUtilsMessengerCallbackDataEXT* data, void*) {
  MessageLog& log = message_log();
  std::lock_guard lock(log.mutex);
  log.messages.emplace_back(data->pMessage);
  return VK_FALSE;
}

VkDebugUtilsMessengerCreateInfoEXT messenger_info() {
  VkDebugUtilsMessengerCreateInfoEXT info{};
  info.sType = VK_STRUCTURE_TYPE_DEBUG_UTILS_MESSENGER_CREATE_INFO_EXT;
  info.messageSeverity = VK_DEBUG_UTILS_MESSAGE_SEVERITY_WARNING_BIT_EXT |
                         VK_DEBUG_UTILS_MESSAGE_SEVERITY_ERROR_BIT_EXT;
  // Not "general": the loader's remarks about other drivers of the machine are none of ours.
  info.messageType = VK_DEBUG_UTILS_MESSAGE_TYPE_VALIDATION_BIT_EXT |
                     VK_DEBUG_UTILS_MESSAGE_TYPE_PERFORMANCE_BIT_EXT;
  info.pfnUserCallback = on_message;
  return info;
}

VkInstance create_instance(bool validation) {
  VkApplicationInfo app{};
  app.sType = VK_STRUCTURE_TYPE_APPLICATION_INFO;
  app.pApplicationName = "edgescout";
  app.apiVersion = VK_API_VERSION_1_2;

  const VkValidationFeatureEnableEXT enable =
      VK_VALIDATION_FEATURE_ENABLE_SYNCHRONIZATION_VALIDATION_EXT;
  VkValidationFeaturesEXT features{};
  features.sType = VK_STRUCTURE_TYPE_VALIDATION_FEATURES_EXT;
  features.enabledValidationFeatureCount = 1;
  features.pEnabledValidationFeatures = &enable;

  const char* layer = "VK_LAYER_KHRONOS_validation";
  std::vector<const char*> extensions;
  VkInstanceCreateInfo info{};
  info.sType = VK_STRUCTURE_TYPE_INSTANCE_CREATE_INFO;
  info.pApplicationInfo = &app;
  if (validation) {
    info.pNext = &features;
    info.enabledLayerCount = 1;
    info.ppEnabledLayerNames = &layer;
    extensions = {VK_EXT_DEBUG_UTILS_EXTENSION_NAME, VK_EXT_VALIDATION_FEATURES_EXTENSION_NAME};
  }
  // Or the loader keeps what is no whole Vulkan, such as MoltenVK, to itself.
  if (instance_offers(VK_KHR_PORTABILITY_ENUMERATION_EXTENSION_NAME)) {
    extensions.push_back(VK_KHR_PORTABILITY_ENUMERATION_EXTENSION_NAME);
    info.flags |= VK_INSTANCE_CREATE_ENUMERATE_PORTABILITY_BIT_KHR;
  }
  info.enabledExtensionCount = static_cast<std::uint32_t>(extensions.size());
  info.ppEnabledExtensionNames = extensions.data();
  VkInstance instance = VK_NULL_HANDLE;
  require(vkCreateInstance(&info, nullptr, &instance),
          validation ? "vkCreateInstance with validation" : "vkCreateInstance");
  return instance;
}

template <class Function>
Function instance_function(VkInstance instance, const char* name) {
  return reinterpret_cast<Function>(vkGetInstanceProcAddr(instance, name));
}

}  // namespace

Instance::Instance(bool validation) : instance_(create_instance(validation)) {
  if (!validation) return;
  const auto create = instance_function<PFN_vkCreateDebugUtilsMessengerEXT>(
      instance_, "vkCreateDebugUtilsMessengerEXT");
  const VkDebugUtilsMessengerCreateInfoEXT info = messenger_info();
  const VkResult result = create(instance_, &info, nullptr, &messenger_);
  if (result == VK_SUCCESS) return;
  vkDestroyInstance(instance_, nullptr);
  require(result, "vkCreateDebugUtilsMessengerEXT");
}

Instance::~Instance() {
  if (messenger_ != VK_NULL_HANDLE)
    instance_function<PFN_vkDestroyDebugUtilsMessengerEXT>(
        instance_, "vkDestroyDebugUtilsMessengerEXT")(instance_, messenger_, nullptr);
  vkDestroyInstance(instance_, nullptr);
}

std::vector<VkPhysicalDevice> Instance::physical_devices() const {
  std::uint32_t count = 0;
  require(vkEnumeratePhysicalDevices(instance_, &count, nullptr), "vkEnumeratePhysicalDevices");
  std::vector<VkPhysicalDevice> devices(count);
  require(vkEnumeratePhysicalDevices(instance_, &count, devices.data()),
          "vkEnumeratePhysicalDevices");
  devices.resize(count);
  return devices;
}

const Instance& shared_instance(bool validation) {
  static std::mutex mutex;
  static const Instance* instances[2] = {};
  std::lock_guard lock(mutex);
  const Instance*& instance = instances[validation ? 1 : 0];
  if (!instance) instance = new Instance(validation);
  return *instance;
}

std::vector<std::string> take_validation_messages() {
  MessageLog& log = message_log();
  std::lock_guard lock(log.mutex);
  return std::exchange(log.messages, {});
}

}  // namespace edgescout::gpu
