// The paths a kernel is tested on, each against the reference backend: the fast CPU path, and a
// Vulkan device as it is, with staged copies, and with tensors cut into bands. Vulkan runs under
// the validation layer, synchronization validation included; any message of it fails the test.
// Without a device the Vulkan paths are skipped; with EDGESCOUT_TESTS_UNVALIDATED in the
// environment they run without the layer. With staged copies the shaders have the shape that they
// have on hardware.
#pragma once

#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <memory>
#include <numbers>
#include <ostream>
#include <random>
#include <string>

#include "kernels/backend.h"

#ifdef EDGESCOUT_VULKAN
#include "kernels/gpu/vulkan_backend.h"
#endif

namespace edgescout::test {

enum class Path { cpu, vulkan, vulkan_staging, vulkan_bands };

inline std::string path_name(Path path) {
  switch (path) {
    case Path::cpu:
      return "cpu";
    case Path::vulkan:
      return "vulkan";
    case Path::vulkan_staging:
      return "vulkan_staging";
    case Path::vulkan_bands:
      return "vulkan_bands";
  }
  return "unknown";
}

inline void PrintTo(Path path, std::ostream* out) { *out << path_name(path); }

inline const auto all_paths =
    ::testing::Values(Path::cpu, Path::vulkan, Path::vulkan_staging, Path::vulkan_bands);
inline std::string param_name(const ::testing::TestParamInfo<Path>& info) {
  return path_name(info.param);
}

// The largest image of the tests' tensors has 70 x 100 px and 60 bins: four bands of 32 rows.
inline constexpr std::uint64_t test_band_bytes = 3 * 60 * 64 * 32;

#ifdef EDGESCOUT_VULKAN
// A machine with a graphics card need not have the layer.
inline bool is_validated() { return std::getenv("EDGESCOUT_TESTS_UNVALIDATED") == nullptr; }

inline gpu::DeviceOptions device_options(Path path) {
  gpu::DeviceOptions options;
  options.index = usual_vulkan_device();
  options.validation = is_validated();
  options.staging = path == Path::vulkan_staging;
  options.as_hardware = options.staging ? 64 : 0;
  options.max_band_bytes = path == Path::vulkan_bands ? test_band_bytes : 0;
  return options;
}
#endif

// Null: this machine has no such path.
inline std::unique_ptr<Backend> make_path(Path path) {
  if (path == Path::cpu) return make_cpu_backend(2);
#ifdef EDGESCOUT_VULKAN
  if (!vulkan_devices().empty()) return gpu::make_backend(device_options(path));
#endif
  return nullptr;
}

inline void expect_no_validation_message() {
#ifdef EDGESCOUT_VULKAN
  for (const std::string& message : gpu::take_validation_messages()) ADD_FAILURE() << message;
#endif
}

// A stream of its own for every test, from the suite's seed and the test's name.
inline std::mt19937 test_rng() {
  const ::testing::TestInfo& info = *::testing::UnitTest::GetInstance()->current_test_info();
  const std::string name = std::string(info.test_suite_name()) + "." + info.name();
  std::uint32_t seed = 20170419;
  for (const char c : name) seed = seed * 16777619u ^ static_cast<unsigned char>(c);
  ::testing::Test::RecordProperty("seed", std::to_string(seed));
  std::printf("seed %u from %s\n", seed, name.c_str());
  return std::mt19937(seed);
}

class PathTest : public ::testing::TestWithParam<Path> {
 protected:
  void SetUp() override {
    tested = make_path(GetParam());
    if (!tested) GTEST_SKIP() << "no Vulkan device";
    RecordProperty("device", tested->name());
    reference = make_reference_backend();
  }
  void TearDown() override {
    tested.reset();
    expect_no_validation_message();
  }

  std::unique_ptr<Backend> tested, reference;
};

// Segments of random place, length and direction, some of them reaching out of the image.
inline std::vector<EdgePoint> random_edges(std::mt19937& rng, int width, int height, int count) {
  std::uniform_real_distribution<float> unit(0, 1);
  std::vector<EdgePoint> edges;
  while (static_cast<int>(edges.size()) < count) {
    const float x = unit(rng) * float(width), y = unit(rng) * float(height),
                theta = unit(rng) * 3.1415926f;
    const int length = 1 + static_cast<int>(unit(rng) * 40);
    for (int s = 0; s < length && static_cast<int>(edges.size()) < count; ++s)
      edges.push_back({x + float(s) * std::cos(theta), y + float(s) * std::sin(theta), theta, 10});
  }
  return edges;
}

}  // namespace edgescout::test
