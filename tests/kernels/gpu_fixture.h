// A validated Vulkan device for the tests that look inside kernels/gpu; skipped where there is
// none.
#pragma once

#include <optional>
#include <vector>

#include "kernels/gpu/batch.h"
#include "tests/kernels/paths.h"

namespace edgescout::test {

class GpuTest : public ::testing::Test {
 protected:
  void SetUp() override {
    if (vulkan_devices().empty()) GTEST_SKIP() << "no Vulkan device";
    gpu::DeviceOptions options = device_options(Path::vulkan);
    options.time_kernels = true;
    device.emplace(options);
  }
  void TearDown() override {
    device.reset();
    expect_no_validation_message();
  }

  template <class T>
  std::vector<T> read(const gpu::RawBuffer& buffer, std::size_t size) const {
    std::vector<T> values(size);
    gpu::Batch batch(*device, "read back");
    batch.download<T>(buffer, values);
    batch.run();
    return values;
  }

  std::optional<gpu::Device> device;
};

}  // namespace edgescout::test
