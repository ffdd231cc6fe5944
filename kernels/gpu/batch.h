// Commands recorded in order, submitted once, waited for. A batch has a name; its kernels are timed
// by theirs.
//
//   Batch batch(device, "dcd_tensor");
//   batch.upload(points, edges);
//   batch.barrier();
//   batch.dispatch(kernel, {groups_x, groups_y}, {points, tensor}, push);
//   batch.download(tensor, values);
//   std::vector<StageTime> times = batch.run();
//
// Nothing is ordered but by barrier(): it stands between an upload, fill or dispatch and whatever
// uses its result. run() orders the last commands before the host's reads itself.
#pragma once

#include <deque>
#include <initializer_list>
#include <span>
#include <string>
#include <vector>

#include <vulkan/vulkan.h>

#include "kernels/backend.h"
#include "kernels/gpu/buffer.h"
#include "kernels/gpu/command_set.h"
#include "kernels/gpu/kernel.h"

namespace edgescout::gpu {

// A buffer, or a range of it, at the next binding of a dispatch.
struct Bound {
  Bound(const RawBuffer& whole)
      : buffer(&whole), bytes(whole.bytes()) {}  // implicit: a dispatch reads as a call
  Bound(const RawBuffer& part, VkDeviceSize from, VkDeviceSize size)
      : buffer(&part), offset(from), bytes(size) {}
  // Its words from 0 on, read as texels where the kernel does.
  Bound(const TexelBuffer& whole) : buffer(&whole), bytes(whole.bytes()), texels(whole.view()) {}
  const RawBuffer* buffer;
  VkDeviceSize offset = 0;
  VkDeviceSize bytes;
  VkBufferView texels = VK_NULL_HANDLE;
};

struct Groups {
  std::uint32_t x = 1, y = 1, z = 1;
};

// Workgroups of `size` that cover `count`.
inline std::uint32_t groups_for(std::size_t count, std::uint32_t size) {
  return static_cast<std::uint32_t>((count + size - 1) / size);
}

// `count` workgroups in two dimensions, for kernels that number them x + y * gl_NumWorkGroups.x: a
// device may take no more than 65535 along one.
inline Groups spread(std::uint32_t count) {
  constexpr std::uint32_t line = 1u << 15;
  return {count < line ? count : line, groups_for(count, line)};
}

class Batch {
 public:
  Batch(const Device& device, std::string name);
  ~Batch();
  Batch(const Batch&) = delete;
  Batch& operator=(const Batch&) = delete;

  // Copies now; the caller's memory is free afterwards. The buffer must not be in use by an earlier
  // command of this batch.
  template <class T>
  void upload(const RawBuffer& to, std::span<const T> values) {
    upload_bytes(to, std::as_bytes(values));
  }
  // The first `bytes` of the buffer, a multiple of 4, become `word`.
  void fill(const RawBuffer& buffer, VkDeviceSize bytes, std::uint32_t word);
  // All of it; `to` must be as large.
  void copy(const RawBuffer& from, const RawBuffer& to);
  // Everything written so far is visible to everything that follows.
  void barrier();
  // Throws GpuError where the device's limits do not take this many groups or a range this long.
  template <class Push>
  void dispatch(const Kernel& kernel, Groups groups, std::initializer_list<Bound> bound,
                const Push& push) {
    dispatch_bytes(kernel, groups, {bound.begin(), bound.size()},
                   std::as_bytes(std::span(&push, 1)));
  }
  // The first values of the buffer, into `to` when run() returns; implies a barrier() where copies
  // are staged.
  template <class T>
  void download(const RawBuffer& from, std::span<T> to) {
    download_bytes(from, std::as_writable_bytes(to));
  }

  const std::string& name() const { return name_; }
  // Once. Throws GpuError naming the batch, its kernels and their sizes. Returns the time each
  // kernel took on the device, summed by name; empty where kernels are not timed.
  std::vector<StageTime> run();

 private:
  struct Download {
    const std::byte* from;
    std::span<std::byte> to;
  };

  void upload_bytes(const RawBuffer& to, std::span<const std::byte> bytes);
  void download_bytes(const RawBuffer& from, std::span<std::byte> to);
  void dispatch_bytes(const Kernel& kernel, Groups groups, std::span<const Bound> bound,
                      std::span<const std::byte> push);
  VkDescriptorSet bind(const Kernel& kernel, std::span<const Bound> bound);
  void check_dispatch(const Kernel& kernel, Groups groups, std::span<const Bound> bound) const;
  const RawBuffer& stage(VkDeviceSize bytes, Memory memory, const RawBuffer& other_end);
  void copy_bytes(VkBuffer from, VkBuffer to, VkDeviceSize bytes);
  void write_timestamp(std::uint32_t which);
  std::vector<StageTime> read_times() const;

  const Device& device_;
  std::string name_;
  CommandSet set_;
  std::vector<std::string> dispatched_;  // kernels, in the order of their timestamps
  std::size_t sets_ = 0;                 // of descriptors
  bool is_running_ = false;              // submitted and, for all that is known, not done
  std::deque<RawBuffer> staging_;
  std::vector<Download> downloads_;
  std::string story_;  // "dcd_seed 12x1x1, dcd_sweep 24x768x1": what an error is about
};

}  // namespace edgescout::gpu
