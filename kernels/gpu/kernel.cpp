#include "kernels/gpu/kernel.h"

#include "kernels/error.h"
#include "kernels/gpu/result.h"

namespace edgescout::gpu {

namespace {

void check_limits(const Device& device, const KernelSource& source) {
  const VkPhysicalDeviceLimits& limits = device.limits();
  if (source.push_bytes > limits.maxPushConstantsSize)
    throw GpuError(std::string(source.name) + ": " + std::to_string(source.push_bytes) +
                   " bytes of push constants, " + device.info().name + " takes " +
                   std::to_string(limits.maxPushConstantsSize));
  if (source.bindings > limits.maxPerStageDescriptorStorageBuffers)
    throw GpuError(std::string(source.name) + ": " + std::to_string(source.bindings) +
                   " storage buffers, " + device.info().name + " takes " +
                   std::to_string(limits.maxPerStageDescriptorStorageBuffers));
}

VkDescriptorSetLayout create_set_layout(VkDevice device, const KernelSource& source) {
  std::vector<VkDescriptorSetLayoutBinding> bindings(source.bindings);
  for (std::uint32_t i = 0; i < source.bindings; ++i)
    bindings[i] = {i,
                   i < source.texel_bindings ? VK_DESCRIPTOR_TYPE_UNIFORM_TEXEL_BUFFER
                                             : VK_DESCRIPTOR_TYPE_STORAGE_BUFFER,
                   1, VK_SHADER_STAGE_COMPUTE_BIT, nullptr};
  VkDescriptorSetLayoutCreateInfo info{};
  info.sType = VK_STRUCTURE_TYPE_DESCRIPTOR_SET_LAYOUT_CREATE_INFO;
  info.bindingCount = source.bindings;
  info.pBindings = bindings.data();
  VkDescriptorSetLayout layout = VK_NULL_HANDLE;
  require(vkCreateDescriptorSetLayout(device, &info, nullptr, &layout),
          std::string(source.name) + ": vkCreateDescriptorSetLayout");
  return layout;
}

VkPipelineLayout create_layout(VkDevice device, VkDescriptorSetLayout set,
                               const KernelSource& source) {
  const VkPushConstantRange push{VK_SHADER_STAGE_COMPUTE_BIT, 0, source.push_bytes};
  VkPipelineLayoutCreateInfo info{};
  info.sType = VK_STRUCTURE_TYPE_PIPELINE_LAYOUT_CREATE_INFO;
  info.setLayoutCount = 1;
  info.pSetLayouts = &set;
  info.pushConstantRangeCount = 1;
  info.pPushConstantRanges = &push;
  VkPipelineLayout layout = VK_NULL_HANDLE;
  require(vkCreatePipelineLayout(device, &info, nullptr, &layout),
          std::string(source.name) + ": vkCreatePipelineLayout");
  return layout;
}

Handle<VkShaderModule> create_module(VkDevice device, const KernelSource& source) {
  VkShaderModuleCreateInfo info{};
  info.sType = VK_STRUCTURE_TYPE_SHADER_MODULE_CREATE_INFO;
  info.codeSize = source.spirv.size_bytes();
  info.pCode = source.spirv.data();
  VkShaderModule shader = VK_NULL_HANDLE;
  require(vkCreateShaderModule(device, &info, nullptr, &shader),
          std::string(source.name) + ": vkCreateShaderModule");
  return {device, shader, vkDestroyShaderModule};
}

VkPipeline create_pipeline(const Device& device, VkPipelineLayout layout,
                           const KernelSource& source) {
  const Handle<VkShaderModule> shader = create_module(device.get(), source);
  std::vector<VkSpecializationMapEntry> entries;
  for (std::uint32_t i = 0; i < source.constants.size(); ++i) entries.push_back({i, 4 * i, 4});
  const VkSpecializationInfo constants{static_cast<std::uint32_t>(entries.size()), entries.data(),
                                       4 * source.constants.size(), source.constants.data()};
  VkComputePipelineCreateInfo info{};
  info.sType = VK_STRUCTURE_TYPE_COMPUTE_PIPELINE_CREATE_INFO;
  info.stage.sType = VK_STRUCTURE_TYPE_PIPELINE_SHADER_STAGE_CREATE_INFO;
  info.stage.stage = VK_SHADER_STAGE_COMPUTE_BIT;
  info.stage.module = shader.get();
  info.stage.pName = "main";
  info.stage.pSpecializationInfo = &constants;
  info.layout = layout;
  VkPipeline pipeline = VK_NULL_HANDLE;
  require(
      vkCreateComputePipelines(device.get(), device.pipeline_cache(), 1, &info, nullptr, &pipeline),
      std::string(source.name) + ": vkCreateComputePipelines");
  return pipeline;
}

}  // namespace

Kernel::Kernel(const Device& device, const KernelSource& source)
    : name_(source.name),
      bindings_(source.bindings),
      push_bytes_(source.push_bytes),
      texel_bindings_(source.texel_bindings) {
  check_limits(device, source);
  set_layout_ = {device.get(), create_set_layout(device.get(), source),
                 vkDestroyDescriptorSetLayout};
  layout_ = {device.get(), create_layout(device.get(), set_layout(), source),
             vkDestroyPipelineLayout};
  pipeline_ = {device.get(), create_pipeline(device, layout(), source), vkDestroyPipeline};
}

}  // namespace edgescout::gpu
