// How much a frame of few poses asks of a device: the bounds that keep its path lean. They are some
// 20 % above what was counted; nothing is allocated. `edgescout bench devices` counts a whole one.
#include <gtest/gtest.h>

#include <algorithm>

#include "tests/detect/rendered_part.h"

namespace edgescout::test {
namespace {

DeviceWork sum(const Detections& found) {
  DeviceWork work;
  for (const StageSeconds& stage : found.stages) work += stage.device;
  return work;
}

const StageSeconds& stage_of(const Detections& found, const char* name) {
  return *std::ranges::find(found.stages, name, &StageSeconds::name);
}

TEST(DeviceWork, OfOneFrameStaysWithinItsBounds) {
  if (vulkan_devices().empty()) GTEST_SKIP() << "no Vulkan device";
  const RenderedPart scene("bearing_block");
  const std::unique_ptr<Backend> device =
      make_vulkan_backend(usual_vulkan_device(), {.time_kernels = true});
  // Two frames allocate what the next ones use again: in the second one a buffer that was freed may
  // have gone to another taker.
  for (int i = 0; i < 2; ++i) scene.detect(0, *device);
  const Detections found = scene.detect(0, *device);
  const DeviceWork frame = sum(found), scan = stage_of(found, "scan").device;
  const double megabytes = 1e-6 * double(frame.bytes_up + frame.bytes_down),
               scan_megabytes = 1e-6 * double(scan.bytes_up + scan.bytes_down);
  EXPECT_GT(frame.submits, 0u);
  EXPECT_GT(frame.kernel_seconds().value_or(0), 0);
  EXPECT_LE(frame.submits, 220u);
  EXPECT_LE(megabytes, 37);
  EXPECT_LE(1e-6 * double(frame.bytes_filled), 190);
  EXPECT_EQ(frame.allocations, 0u);
  EXPECT_LE(scan.submits, 5u);
  EXPECT_LE(scan_megabytes, 1.6);
}

TEST(DeviceWork, OfTheCpuIsNone) {
  const RenderedPart scene("bearing_block");
  const std::unique_ptr<Backend> cpu = make_cpu_backend(2);
  const DeviceWork frame = sum(scene.detect(0, *cpu));
  EXPECT_EQ(frame.submits, 0u);
  EXPECT_EQ(frame.bytes_up + frame.bytes_down + frame.bytes_filled, 0u);
}

}  // namespace
}  // namespace edgescout::test
