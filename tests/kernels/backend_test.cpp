// The choice of a backend by its word, and the timings every backend keeps.
#include "kernels/backend.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "kernels/error.h"
#include "tests/kernels/paths.h"

namespace edgescout {
namespace {

TEST(BackendChoice, WordsNameBackends) {
  EXPECT_EQ(make_backend("cpu")->name(), "cpu");
  EXPECT_EQ(make_backend("cpu-reference")->name(), "cpu-reference");
  EXPECT_FALSE(make_backend("cpu")->is_gpu());
}

// Not one of Vulkan 1.1, for one.
bool opens(const DeviceInfo& device) {
  try {
    return make_backend("vulkan:" + std::to_string(device.index))->is_gpu();
  } catch (const GpuError&) {
    return false;
  }
}

TEST(BackendChoice, AutoTakesHardwareElseTheFastCpuPath) {
  bool hardware = false;
  for (const DeviceInfo& device : vulkan_devices())
    hardware = hardware || (device.hardware && opens(device));
  EXPECT_EQ(make_backend("auto")->is_gpu(), hardware);
}

TEST(BackendChoice, CardsComeBeforeOtherHardwareAndThatBeforeSoftware) {
  std::vector<DeviceInfo> devices(5);
  for (int i = 0; i < 5; ++i) devices[i].index = i;
  devices[1].hardware = devices[2].hardware = devices[4].hardware = true;
  devices[2].discrete = devices[4].discrete = true;
  std::vector<int> order;
  for (const DeviceInfo& device : in_order_of_use(devices)) order.push_back(device.index);
  EXPECT_EQ(order, (std::vector<int>{2, 4, 1, 0, 3}));
  EXPECT_TRUE(in_order_of_use({}).empty());
}

TEST(BackendChoice, VulkanByNameTakesAnyDevice) {
  if (vulkan_devices().empty()) GTEST_SKIP() << "no Vulkan device";
  const auto backend = make_backend("vulkan:0");
  EXPECT_TRUE(backend->is_gpu());
  EXPECT_EQ(backend->name(), "vulkan:0 " + vulkan_devices()[0].name);
}

TEST(BackendChoice, OtherWordsAreBadInput) {
  for (const char* word : {"", "gpu", "CPU", "vulkan:", "vulkan:x", "vulkan:-1", "vulkan:0x",
                           "vulkan:99999999999", "vulkan:77"})
    EXPECT_THROW(make_backend(word), InputError) << word;
}

TEST(BackendChoice, WithoutADeviceAskingForOneIsBadInput) {
  if (!vulkan_devices().empty()) GTEST_SKIP() << "there is a device";
  EXPECT_THROW(make_backend("vulkan"), InputError);
}

TEST(CpuBackend, SaysWhichTensorIsTooLargeForTheMemory) {
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
  GTEST_SKIP() << "the sanitizer ends the program where an allocation fails";
#endif
  for (const char* word : {"cpu", "cpu-reference"}) try {
      make_backend(word)->make_view({}, 1 << 22, 1 << 21, {}, {}, {});
      FAIL() << "a tensor of a thousand terabytes";
    } catch (const InputError& error) {
      for (const char* part : {"dcd_tensor", "4194304x2097152", "60 bins"})
        EXPECT_NE(std::string(error.what()).find(part), std::string::npos) << error.what();
    }
}

class BackendTimings : public test::PathTest {};

TEST_P(BackendTimings, AreTakenOnce) {
  std::mt19937 rng = test::test_rng();
  const auto edges = test::random_edges(rng, 33, 17, 20);
  tested->make_view(edges, 33, 17, {}, {}, {});
  tested->make_view(edges, 33, 17, {}, {}, {});
  const std::vector<StageTime> times = tested->take_timings();
  ASSERT_FALSE(times.empty());
  for (const StageTime& time : times) {
    EXPECT_FALSE(time.name.empty());
    EXPECT_GE(time.calls, 2) << time.name;
    EXPECT_GE(time.seconds, 0) << time.name;
  }
  EXPECT_TRUE(tested->take_timings().empty());
}

// Of one who asks for them; another one gets the times of whole batches.
TEST_P(BackendTimings, AreThoseOfKernelsWhereTheyAreTimed) {
  if (GetParam() == test::Path::cpu) GTEST_SKIP() << "a CPU path always takes times";
#ifdef EDGESCOUT_VULKAN
  for (const bool timed : {false, true}) {
    gpu::DeviceOptions options = test::device_options(GetParam());
    options.time_kernels = timed;
    const auto backend = gpu::make_backend(options);
    backend->make_view({}, 33, 17, {}, {}, {});
    const std::vector<StageTime> times = backend->take_timings();
    const auto has = [&](const char* name) {
      return std::ranges::find(times, name, &StageTime::name) != times.end();
    };
    EXPECT_EQ(has("dcd_sweep"), timed);
    EXPECT_EQ(has(HOST_STAGE), timed);
    EXPECT_EQ(has("dcd_tensor"), !timed);
    EXPECT_EQ(backend->device_work().kernel_seconds().has_value(), timed);
  }
#endif
}

TEST_P(BackendTimings, ViewsOfAnotherBackendAreOurBugs) {
  const ViewHandle foreign = reference->make_view({}, 8, 8, {}, {}, {});
  const std::vector<TemplatePoint> points{{0, 0, 0}};
  const std::vector<TemplateJob> jobs{{0, 1, 0, 0, 1, 1}};
  std::vector<TemplateHit> hits(1);
  if (GetParam() == test::Path::cpu) GTEST_SKIP() << "CPU backends share their views";
  EXPECT_THROW(tested->template_score(*foreign, points, jobs, 1, hits), LogicError);
}

INSTANTIATE_TEST_SUITE_P(Paths, BackendTimings, test::all_paths, test::param_name);

}  // namespace
}  // namespace edgescout
