// A compute pipeline made from embedded SPIR-V: storage buffers, or uniform texel buffers of words,
// at bindings 0..n-1 of set 0, push constants in one struct.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include <vulkan/vulkan.h>

#include "kernels/gpu/device.h"
#include "kernels/gpu/handle.h"

namespace edgescout::gpu {

struct KernelSource {
  const char* name;
  std::span<const std::uint32_t> spirv;
  std::uint32_t bindings;
  std::uint32_t push_bytes;
  std::vector<std::uint32_t> constants;  // specialization constants 0..n-1
  std::uint32_t texel_bindings = 0;      // so many of the first ones are uniform texel buffers
};

class Kernel {
 public:
  // Throws GpuError naming the kernel and the failing call or the exceeded limit.
  Kernel(const Device& device, const KernelSource& source);

  const std::string& name() const { return name_; }
  VkPipeline pipeline() const { return pipeline_.get(); }
  VkPipelineLayout layout() const { return layout_.get(); }
  VkDescriptorSetLayout set_layout() const { return set_layout_.get(); }
  std::uint32_t bindings() const { return bindings_; }
  std::uint32_t push_bytes() const { return push_bytes_; }
  bool is_texel(std::uint32_t binding) const { return binding < texel_bindings_; }

 private:
  std::string name_;
  std::uint32_t bindings_, push_bytes_, texel_bindings_;
  Handle<VkDescriptorSetLayout> set_layout_;
  Handle<VkPipelineLayout> layout_;
  Handle<VkPipeline> pipeline_;
};

}  // namespace edgescout::gpu
