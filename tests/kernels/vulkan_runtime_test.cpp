// The runtime under kernels/gpu: what it says when something is missing, too large or wrong.
#ifdef EDGESCOUT_VULKAN
#include "kernels/error.h"
#include "kernels/gpu/edge_detect.h"
#include "kernels/gpu/result.h"
#include "kernels/gpu/template_score.h"
#include "kernels/gpu/tensor.h"
#include "tests/kernels/gpu_fixture.h"

#include "dcd_seed.spv.h"
#include "kernels/dcd_seed.h"

// What the sanitizers see inside the validation layer and the software driver is none of ours:
// neither was built for them. What we forget to destroy the layer reports, and that fails the test
// that did it.
// The sanitizers' runtimes give the names. NOLINTBEGIN(bugprone-reserved-identifier)
extern "C" const char* __lsan_default_suppressions();
extern "C" const char* __lsan_default_suppressions() {
  return "leak:libVkLayer_khronos_validation.so\nleak:libvulkan_lvp.so\nleak:libLLVM\n";
}
extern "C" const char* __tsan_default_suppressions();
extern "C" const char* __tsan_default_suppressions() {
  return "race:libVkLayer_khronos_validation.so\ndeadlock:libVkLayer_khronos_validation.so\n"
         "mutex:libVkLayer_khronos_validation.so\nrace:libvulkan_lvp.so\ndeadlock:libvulkan_lvp."
         "so\n"
         "mutex:libvulkan_lvp.so\nrace:libLLVM\n";
}
// NOLINTEND(bugprone-reserved-identifier)

namespace edgescout {
namespace {

using gpu::Batch;
using gpu::Buffer;
using gpu::Kernel;
using gpu::Memory;

template <class Error, class Function>
std::string message_of(Function function) {
  try {
    function();
  } catch (const Error& error) {
    return error.what();
  }
  ADD_FAILURE() << "nothing was thrown";
  return {};
}

bool contains(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

class VulkanRuntime : public test::GpuTest {
 protected:
  Kernel seed_kernel(std::uint32_t push_bytes = sizeof(DcdSeedPush)) const {
    return Kernel(*device, {"dcd_seed", dcd_seed_spv, 6, push_bytes, {DCD_SEED_MARK}});
  }
};

TEST_F(VulkanRuntime, AMissingDeviceIsNamed) {
  const std::string message = message_of<GpuError>([] { make_vulkan_backend(99); });
  EXPECT_TRUE(contains(message, "99")) << message;
  EXPECT_THROW(make_vulkan_backend(-1), GpuError);
  const std::string asked = message_of<InputError>([] { make_backend("vulkan:99"); });
  EXPECT_TRUE(contains(asked, "device") && contains(asked, "vulkan:99") &&
              contains(asked, "vulkan:0"))
      << asked;
}

TEST_F(VulkanRuntime, DescribesItsDevices) {
  for (const DeviceInfo& info : vulkan_devices()) {
    EXPECT_FALSE(info.name.empty());
    EXPECT_FALSE(info.driver.empty());
    EXPECT_GT(info.memory_bytes, 1u << 20);
    EXPECT_GE(info.max_storage_buffer_bytes, 1u << 27);  // what Vulkan promises everywhere
  }
}

// A display's watchdog ends a dispatch that takes seconds, and the device is lost.
TEST_F(VulkanRuntime, ABatchOfTemplatesIsNoLongWork) {
  const gpu::TemplateScore templates(*device);
  const TemplateJob largest{0,   TEMPLATE_SCORE_MAX_POINTS,       0, 0,
                            128, TEMPLATE_SCORE_MAX_ANCHORS / 128};
  EXPECT_EQ(templates.that_fit(std::vector<TemplateJob>(200, largest)), 128u) << "2^28 lookups";
  EXPECT_EQ(templates.that_fit(std::vector<TemplateJob>(100, largest)), 100u);
  EXPECT_EQ(templates.that_fit({}), 0u);
}

TEST_F(VulkanRuntime, TooMuchMemoryNamesBufferAndSize) {
  const std::string message = message_of<GpuError>(
      [&] { gpu::RawBuffer(*device, ~VkDeviceSize{0} / 2, Memory::device, "a whale"); });
  EXPECT_TRUE(contains(message, "'a whale'") && contains(message, "9223372036854775807"))
      << message;
}

// Or every later use of the buffer would fail: it is bound whole, and never shrinks.
TEST_F(VulkanRuntime, ABufferDoesNotGrowBeyondWhatIsBound) {
  Buffer<float> buffer(*device, 8, "a pond");
  const std::size_t most = device->limits().maxStorageBufferRange / sizeof(float);
  const std::string message =
      message_of<GpuError>([&] { buffer.reserve(*device, most + 1, "a lake"); });
  EXPECT_TRUE(contains(message, "'a lake'") && contains(message, std::to_string(4 * (most + 1))))
      << message;
  EXPECT_EQ(buffer.size(), 8u);
}

TEST_F(VulkanRuntime, ATensorTooLargeForTheDeviceIsBadInput) {
  const std::string message = message_of<InputError>([&] {
    gpu::DeviceTensor(*device, {30000, 30000, 128});
  });
  EXPECT_TRUE(contains(message, "30000x30000") && contains(message, device->info().name))
      << message;
}

TEST_F(VulkanRuntime, AnImageTooLargeForTheDeviceIsBadInput) {
  const std::size_t side =
      1 + static_cast<std::size_t>(std::sqrt(double(device->limits().maxStorageBufferRange) / 4));
  if (side > 10000) GTEST_SKIP() << "this device takes more than a test should allocate";
  const std::vector<std::uint8_t> pixels(side * side, 0);
  const int size = static_cast<int>(side);
  gpu::EdgeDetect detect(*device);
  Batch batch(*device, "edges");
  const std::string message = message_of<InputError>([&] {
    detect.record_pixels(batch, {size, size, pixels.data()}, {});
  });
  EXPECT_TRUE(contains(message, std::to_string(size)) && contains(message, device->info().name))
      << message;
}

TEST_F(VulkanRuntime, TooManyWorkgroupsNameTheKernelAndItsSize) {
  const Kernel kernel = seed_kernel();
  const Buffer<std::uint32_t> buffer(*device, 1, "word");
  Batch batch(*device, "too many");
  const std::string message = message_of<GpuError>([&] {
    batch.dispatch(kernel, {1, 0xffffffffu, 1}, {buffer, buffer, buffer, buffer, buffer, buffer},
                   DcdSeedPush{});
  });
  EXPECT_TRUE(contains(message, "dcd_seed 1x4294967295x1")) << message;
}

TEST_F(VulkanRuntime, WrongBindingsAndPushConstantsAreOurBugs) {
  const Kernel kernel = seed_kernel();
  const Buffer<std::uint32_t> buffer(*device, 1, "word");
  Batch batch(*device, "wrong");
  EXPECT_THROW(batch.dispatch(kernel, {1}, {buffer}, DcdSeedPush{}), LogicError);
  EXPECT_THROW(batch.dispatch(kernel, {1}, {buffer, buffer, buffer, buffer, buffer, buffer}, 1.0f),
               LogicError);
}

TEST_F(VulkanRuntime, TooManyPushConstantsNameTheKernel) {
  const std::string message = message_of<GpuError>([&] { seed_kernel(1u << 20); });
  EXPECT_TRUE(contains(message, "dcd_seed") && contains(message, "1048576")) << message;
}

TEST_F(VulkanRuntime, CopiesWholeAndInPartWithAndWithoutStaging) {
  for (const test::Path path : {test::Path::vulkan, test::Path::vulkan_staging}) {
    const gpu::Device other(test::device_options(path));
    EXPECT_TRUE(path == test::Path::vulkan || !other.unified_memory());
    const Buffer<std::uint32_t> buffer(other, 5, "five words");
    const std::vector<std::uint32_t> two{7, 8};
    std::vector<std::uint32_t> found(5);
    Batch batch(other, "copies");
    batch.fill(buffer, buffer.bytes(), 3);
    batch.run();
    Batch second(other, "copies");
    second.upload<std::uint32_t>(buffer, two);
    second.download<std::uint32_t>(buffer, found);
    second.run();
    EXPECT_EQ(found, (std::vector<std::uint32_t>{7, 8, 3, 3, 3}));
  }
}

// Both batches record in the same pools, the second time reset.
TEST_F(VulkanRuntime, KernelsAreTimedByName) {
  if (!device->times_kernels()) GTEST_SKIP() << "the device has no clock";
  const Kernel kernel = seed_kernel();
  const Buffer<std::uint32_t> buffer(*device, 8, "words");
  for (int again = 0; again < 2; ++again) {
    Batch batch(*device, "timed");
    const int dispatches = 70 - again;  // more than a pool of descriptors holds, or of queries
    for (int i = 0; i < dispatches; ++i) {
      batch.dispatch(kernel, {1}, {buffer, buffer, buffer, buffer, buffer, buffer}, DcdSeedPush{});
      batch.barrier();
    }
    const std::vector<StageTime> times = batch.run();
    ASSERT_EQ(times.size(), 1u);
    EXPECT_EQ(times[0].name, "dcd_seed");
    EXPECT_EQ(times[0].calls, dispatches);
    EXPECT_GT(times[0].seconds, 0);
    EXPECT_LT(times[0].seconds, 60);
  }
}

TEST_F(VulkanRuntime, KernelsAreNotTimedUnlessAsked) {
  const gpu::Device untimed(test::device_options(test::Path::vulkan));
  const Kernel kernel(untimed, {"dcd_seed", dcd_seed_spv, 6, sizeof(DcdSeedPush), {DCD_SEED_MARK}});
  const Buffer<std::uint32_t> buffer(untimed, 8, "words");
  Batch batch(untimed, "untimed");
  batch.dispatch(kernel, {1}, {buffer, buffer, buffer, buffer, buffer, buffer}, DcdSeedPush{});
  EXPECT_TRUE(batch.run().empty());
  EXPECT_FALSE(untimed.work().kernel_seconds()) << "not measured is not 0";
}

// What was recorded and thrown away leaves nothing behind for the next.
TEST_F(VulkanRuntime, ABatchThatNeverRanDoesNothing) {
  const std::vector<std::uint32_t> ones(4, 1);
  const Buffer<std::uint32_t> buffer(*device, 4, "words");
  {
    Batch batch(*device, "filled");
    batch.upload<std::uint32_t>(buffer, ones);
    batch.run();
  }
  { Batch(*device, "thrown away").fill(buffer, buffer.bytes(), 2); }
  EXPECT_EQ(read<std::uint32_t>(buffer, 4), ones);
}

// Which no device must have; the host then reads through memory that is not cached.
TEST_F(VulkanRuntime, DoesWithoutCachedMemory) {
  const gpu::Device uncached(test::device_options(test::Path::vulkan_staging));
  EXPECT_FALSE(uncached.unified_memory());
  EXPECT_THROW(uncached.memory_type(~0u, VK_MEMORY_PROPERTY_HOST_CACHED_BIT, 0), GpuError);
  EXPECT_NE(gpu::RawBuffer(uncached, 64, Memory::download, "a pool").mapped(), nullptr);
}

TEST_F(VulkanRuntime, CountsTheDevicesMemoryAlone) {
  forget_peak_device_memory();
  const std::uint64_t before = peak_device_memory_bytes();
  const gpu::RawBuffer up(*device, 1 << 20, Memory::upload, "up"),
      down(*device, 1 << 20, Memory::download, "down");
  EXPECT_EQ(peak_device_memory_bytes(), before);
  const gpu::RawBuffer on_device(*device, 1 << 20, Memory::device, "on the device");
  EXPECT_GE(peak_device_memory_bytes(), before + (1 << 20));
}

TEST_F(VulkanRuntime, KeepsMemoryForTheNextTakerOfItsKindAndSize) {
  const gpu::Device other(test::device_options(test::Path::vulkan));
  const auto allocations_of = [&](std::size_t bytes, Memory memory) {
    const std::uint64_t before = other.work().allocations;
    const gpu::RawBuffer buffer(other, bytes, memory, "taken");
    EXPECT_EQ(buffer.bytes(), bytes);
    return other.work().allocations - before;
  };
  EXPECT_EQ(allocations_of(1 << 20, Memory::device), 1u);
  EXPECT_EQ(allocations_of(1 << 20, Memory::device), 0u);
  EXPECT_EQ(allocations_of((1 << 20) - (1 << 16), Memory::device), 0u) << "a little shorter";
  EXPECT_EQ(allocations_of(1 << 19, Memory::device), 1u) << "half of it would lie idle";
  EXPECT_EQ(allocations_of(3 << 19, Memory::device), 1u);
  EXPECT_EQ(allocations_of(1 << 20, Memory::upload), 1u);
  const std::uint64_t before = other.work().allocations;
  const gpu::RawBuffer first(other, 1 << 20, Memory::device, "first"),
      second(other, 1 << 20, Memory::device, "second");
  EXPECT_EQ(other.work().allocations - before, 1u) << "what is in use is not given away";
}

TEST_F(VulkanRuntime, KeepsNoMoreFreeMemoryThanItsBound) {
  const gpu::Device other(test::device_options(test::Path::vulkan));
  constexpr std::size_t mib = 1 << 20, size = 40 * mib;
  const auto held = [] {
    forget_peak_device_memory();
    return peak_device_memory_bytes();
  };
  const std::uint64_t before = held();
  {
    std::vector<gpu::RawBuffer> buffers;
    for (int i = 0; i < 15; ++i) buffers.emplace_back(other, size, Memory::device, "one of many");
  }
  EXPECT_GT(held() - before, 0u);
  EXPECT_LE(held() - before, 512 * mib);
}

TEST_F(VulkanRuntime, CopiesWholeBuffers) {
  std::vector<std::uint32_t> values(1000);
  for (std::size_t i = 0; i < values.size(); ++i) values[i] = static_cast<std::uint32_t>(7 * i);
  const Buffer<std::uint32_t> from(*device, values.size(), "from"),
      to(*device, values.size() + 1, "to"), small(*device, 10, "small");
  Batch batch(*device, "copy");
  batch.upload<std::uint32_t>(from, values);
  batch.fill(to, to.bytes(), 9);
  batch.barrier();
  batch.copy(from, to);
  EXPECT_THROW(batch.copy(from, small), LogicError);
  batch.barrier();
  batch.run();
  values.push_back(9);
  EXPECT_EQ(read<std::uint32_t>(to, values.size()), values);
}

// Without this the other tests' silence would prove nothing.
TEST_F(VulkanRuntime, ValidationSeesAMissingBarrier) {
  if (!test::is_validated()) GTEST_SKIP() << "without the validation layer";
  const Kernel kernel = seed_kernel();
  const Buffer<std::uint32_t> a(*device, 64, "a"), b(*device, 64, "b"), c(*device, 64, "c"),
      d(*device, 64, "d"), e(*device, 64, "e"), f(*device, 64, "f");
  Batch batch(*device, "hazard");
  batch.fill(b, b.bytes(), 0);
  batch.dispatch(kernel, {1}, {a, b, c, d, e, f}, DcdSeedPush{});
  batch.run();
  bool seen = false;
  for (const std::string& message : gpu::take_validation_messages())
    seen = seen || contains(message, "SYNC-HAZARD");
  EXPECT_TRUE(seen);
}

TEST(VulkanResult, NamesWhatItKnows) {
  EXPECT_EQ(gpu::result_name(VK_ERROR_DEVICE_LOST), "VK_ERROR_DEVICE_LOST");
  EXPECT_EQ(gpu::result_name(static_cast<VkResult>(-123456)), "VkResult -123456");
  EXPECT_EQ(message_of<GpuError>([] {
              gpu::require(VK_ERROR_DEVICE_LOST, "edges (edge_link 3x1x1): vkWaitForFences");
            }),
            "edges (edge_link 3x1x1): vkWaitForFences: VK_ERROR_DEVICE_LOST");
}

}  // namespace
}  // namespace edgescout
#endif
