// The comparison of devices: what is worked out from the times, and what is warned of.
#include <gtest/gtest.h>

#include <cstring>
#include <nlohmann/json.hpp>
#include <vector>

#include "host/experiments/devices.h"
#include "kernels/error.h"

namespace edgescout::test {
namespace {

DevicesReport report() {
  DevicesReport report;
  report.load = {4, 0.5, 0.97};
  report.load_at_end = {4, 3.9, 0.5};
  report.warnings = {"something is odd"};
  report.width = 1024;
  report.height = 768;
  report.instances = 5;
  report.poses = 40;
  report.commit = "abc";
  report.settings = {{"coarse-poses", "600"}, {"lambda", "30"}};
  DeviceTimes cpu, card;
  cpu.name = "cpu";
  cpu.stages = {{"edges", {4, 2, 3}}, {"image to poses", {400, 500, 800}}};
  cpu.peak_host_bytes = 300u << 20;
  card.name = "vulkan:0 card";
  card.driver = "driver 1";
  card.stages = {{"edges", {1, 1.5, 2}}, {"image to poses", {100, 50, 40}}};
  card.stages[1].host_ms = {30, 70, 20};
  card.stages[1].device = {12, 34, 2500000, 1250000, 750000, 3, 34, 0.02};
  card.peak_device_bytes = 64u << 20;
  card.copy_bytes_per_s = 2e9;
  // 4 MB at 2 GB/s take 2 ms; of the call's 5 the kernel took 4, as three repetitions' 12 say.
  card.kernels = {{"dcd_tensor",
                   "64x48",
                   3,
                   5,
                   4,
                   6,
                   4000000,
                   {{"stamp", 0.009, 3}, {"pass", 0.003, 3}, {HOST_STAGE, 0.003, 3}}},
                  {"pose_score", "40", 3, 5, 4, 6, 4000000, {}}};
  report.devices = {cpu, card};
  return report;
}

TEST(DevicesReport, AsJsonHasMediansRatiosAndFloors) {
  const nlohmann::json json = nlohmann::json::parse(devices_json(report()));
  EXPECT_EQ(json.at("commit"), "abc");
  EXPECT_EQ(json.at("warnings").at(0), "something is odd");
  EXPECT_EQ(json.at("processor_share"), 0.97);
  EXPECT_EQ(json.at("processor_share_at_end"), 0.5);
  const nlohmann::json& cpu = json.at("devices").at(0);
  const nlohmann::json& card = json.at("devices").at(1);
  EXPECT_EQ(cpu.at("stages").at(0).at("median_ms"), 3);
  EXPECT_EQ(cpu.at("stages").at(0).at("min_ms"), 2);
  EXPECT_EQ(cpu.at("stages").at(0).at("max_ms"), 4);
  EXPECT_EQ(cpu.at("images_per_second"), 2);
  EXPECT_EQ(card.at("stages").at(0).at("times_cpu"), 0.5);
  EXPECT_EQ(card.at("stages").at(1).at("times_cpu"), 0.1);
  EXPECT_EQ(card.at("images_per_second"), 20);
  EXPECT_EQ(card.at("kernels").at(0).at("floor_ms"), 2);
  EXPECT_DOUBLE_EQ(card.at("kernels").at(0).at("kernel_ms").get<double>(), 4);
  EXPECT_DOUBLE_EQ(card.at("kernels").at(0).at("times_floor").get<double>(), 2);
  EXPECT_EQ(card.at("kernels").at(1).at("times_floor"), 2.5)
      << "without a clock of its own the whole call";
  EXPECT_FALSE(cpu.contains("kernels"));
  const nlohmann::json& work = card.at("stages").at(1).at("device");
  EXPECT_EQ(work.at("host_ms"), 30);
  EXPECT_EQ(work.at("submits"), 12);
  EXPECT_EQ(work.at("bytes_down"), 1250000);
  EXPECT_EQ(work.at("allocations"), 3);
  EXPECT_FALSE(cpu.at("stages").at(1).contains("device"));
}

TEST(DevicesReport, AsMarkdownHasARowAStageADeviceAndAKernel) {
  const std::string text = devices_markdown(report());
  for (const char* row :
       {"| edges | 3.0 (2.0 to 4.0) | 1.00 | 1.5 (1.0 to 2.0) | 0.50 |",
        "| image to poses | 500.0 (400.0 to 800.0) | 1.00 | 50.0 (40.0 to 100.0) | 0.10 |",
        "| cpu |  | 2.00 | 300 | 0 |  |", "| vulkan:0 card | driver 1 | 20.00 | 0 | 64 | 2.0 |",
        "## Work of vulkan:0 card", "| image to poses | 30.0 | 12 | 34 | 2.50 | 1.25 | 0.75 | 3 |",
        "| dcd_tensor | 64x48 | 5.000 | 4.000 | 2.000 | 2.0 |", "**Warning:** something is odd",
        "Options: coarse-poses 600, lambda 30, on ",
        "97 % of the processors to be had before, 50 % at the end."})
    EXPECT_NE(text.find(row), std::string::npos) << row << " not in\n" << text;
}

TEST(DevicesReport, SaysWhereKernelsWereNotMeasured) {
  DevicesReport untimed = report();
  untimed.devices[1].stages[1].host_ms.clear();
  EXPECT_TRUE(nlohmann::json::parse(devices_json(untimed))
                  .at("devices")
                  .at(1)
                  .at("stages")
                  .at(1)
                  .at("device")
                  .at("host_ms")
                  .is_null());
  EXPECT_NE(devices_markdown(untimed).find("| image to poses | not measured | 12 | 34 |"),
            std::string::npos);
}

TEST(MachineLoad, IsWarnedOfWhereItSpoilsTimes) {
  EXPECT_TRUE(warnings_of({8, 1.9, 0.95}).empty());
  ASSERT_EQ(warnings_of({8, 2.1, 0.95}).size(), 1u);
  EXPECT_NE(warnings_of({8, 2.1, 0.95})[0].find("load average 2.10 on 8 threads"),
            std::string::npos);
  ASSERT_EQ(warnings_of({8, -1, 0.5}).size(), 1u) << "no load average is no warning";
  EXPECT_NE(warnings_of({8, -1, 0.5})[0].find("50 %"), std::string::npos);
  EXPECT_EQ(warnings_of({2, 3, 0.5}).size(), 2u);
  EXPECT_TRUE(warnings_at_end({8, 7.9, 0.95}).empty())
      << "the load average is the measurement's own";
  ASSERT_EQ(warnings_at_end({8, 7.9, 0.5}).size(), 1u);
  EXPECT_NE(warnings_at_end({8, 7.9, 0.5})[0].find("at the end: only 50 %"), std::string::npos);
}

TEST(MachineLoad, OfThisMachineIsAShare) {
  const MachineLoad load = machine_load();
  EXPECT_GE(load.threads, 1);
  EXPECT_GT(load.share, 0);
  EXPECT_LE(load.share, 1.01);
}

TEST(PeakMemory, GrowsByWhatIsTouchedAndIsForgotten) {
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
  GTEST_SKIP() << "a sanitizer keeps what was freed, or shadows it";
#endif
  constexpr std::size_t SIZE = std::size_t{200} << 20;
  const bool forgets = forget_peak_memory();
  const std::size_t before = peak_memory_bytes();
  if (!forgets || before == 0) GTEST_SKIP() << "the system does not tell";
  {
    std::vector<char> block(SIZE);
    std::memset(block.data(), 1, block.size());
    EXPECT_EQ(block[SIZE / 2], 1);
  }
  const std::size_t grown = peak_memory_bytes() - before;
  EXPECT_GT(grown, SIZE - (SIZE >> 4));
  EXPECT_LT(grown, SIZE + (SIZE >> 2));
  forget_peak_memory();
  EXPECT_LT(peak_memory_bytes(), before + SIZE / 2);
}

TEST(DevicesOptions, NameWhatIsOutOfBounds) {
  DevicesOptions options;
  options.repetitions = 2;
  EXPECT_THROW(options.validate(), InputError);
  options = {};
  options.image_scale = 0;
  EXPECT_THROW(options.validate(), InputError);
}

}  // namespace
}  // namespace edgescout::test
