// Writes the comparison of devices as JSON and as Markdown tables.
#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "host/experiments/decision.h"
#include "host/experiments/devices.h"
#include "host/experiments/rates.h"
#include "host/io/json_text.h"

namespace edgescout {

namespace {

constexpr double MIB = 1 << 20;

double least(const StageSamples& stage) { return *std::ranges::min_element(stage.ms); }
double most(const StageSamples& stage) { return *std::ranges::max_element(stage.ms); }

double images_per_second(const DeviceTimes& device) {
  return 1000 / std::ranges::find(device.stages, IMAGE_TO_POSES, &StageSamples::stage)->median_ms();
}

// The time of copying as many bytes.
double floor_ms(const bench::Row& kernel, const DeviceTimes& device) {
  return 1000 * static_cast<double>(kernel.bytes) / device.copy_bytes_per_s;
}

// The time of the kernel itself, without the host's share.
double kernel_ms(const bench::Row& kernel) {
  return kernel.on_device_ms().value_or(kernel.median_ms);
}

double times_floor(const bench::Row& kernel, const DeviceTimes& device) {
  return kernel_ms(kernel) / floor_ms(kernel, device);
}

constexpr double MB = 1e6;

double megabytes(std::uint64_t bytes) { return static_cast<double>(bytes) / MB; }

nlohmann::ordered_json host_ms_json(const StageSamples& stage) {
  if (stage.host_ms.empty()) return nullptr;
  return median(stage.host_ms);
}

std::string host_ms_text(const StageSamples& stage) {
  return stage.host_ms.empty() ? "not measured" : fmt::format("{:.1f}", median(stage.host_ms));
}

nlohmann::ordered_json work_json(const StageSamples& stage) {
  const DeviceWork& work = stage.device;
  return {{"host_ms", host_ms_json(stage)}, {"submits", work.submits},
          {"dispatches", work.dispatches},  {"bytes_up", work.bytes_up},
          {"bytes_down", work.bytes_down},  {"bytes_filled", work.bytes_filled},
          {"allocations", work.allocations}};
}

nlohmann::ordered_json device_json(const DeviceTimes& device, const DeviceTimes& cpu) {
  nlohmann::ordered_json json{{"device", device.name},
                              {"driver", device.driver},
                              {"software", device.is_software},
                              {"images_per_second", images_per_second(device)},
                              {"peak_host_bytes", device.peak_host_bytes},
                              {"peak_device_bytes", device.peak_device_bytes}};
  for (std::size_t s = 0; s < device.stages.size(); ++s) {
    const StageSamples& stage = device.stages[s];
    json["stages"].push_back({{"stage", stage.stage},
                              {"median_ms", stage.median_ms()},
                              {"min_ms", least(stage)},
                              {"max_ms", most(stage)},
                              {"repetitions", stage.ms.size()},
                              {"times_cpu", stage.median_ms() / cpu.stages[s].median_ms()}});
    if (stage.device.submits > 0) json["stages"].back()["device"] = work_json(stage);
  }
  if (device.kernels.empty()) return json;
  json["copy_bytes_per_s"] = device.copy_bytes_per_s;
  for (const bench::Row& kernel : device.kernels)
    json["kernels"].push_back({{"kernel", kernel.kernel},
                               {"size", kernel.size},
                               {"median_ms", kernel.median_ms},
                               {"min_ms", kernel.min_ms},
                               {"max_ms", kernel.max_ms},
                               {"kernel_ms", kernel_ms(kernel)},
                               {"bytes", kernel.bytes},
                               {"floor_ms", floor_ms(kernel, device)},
                               {"times_floor", times_floor(kernel, device)}});
  return json;
}

std::string stage_table(const DevicesReport& report) {
  std::string head = "| stage |", line = "|---|", text;
  for (const DeviceTimes& device : report.devices)
    head += fmt::format(" {}, ms (least to most) | times CPU |", device.name), line += "---|---|";
  const DeviceTimes& cpu = report.devices[0];
  for (std::size_t s = 0; s < cpu.stages.size(); ++s) {
    text += "| " + cpu.stages[s].stage + " |";
    for (const DeviceTimes& device : report.devices) {
      const StageSamples& stage = device.stages[s];
      text += fmt::format(" {:.1f} ({:.1f} to {:.1f}) | {:.2f} |", stage.median_ms(), least(stage),
                          most(stage), stage.median_ms() / cpu.stages[s].median_ms());
    }
    text += "\n";
  }
  return head + "\n" + line + "\n" + text;
}

std::string device_table(const DevicesReport& report) {
  std::string text =
      "| device | driver | images/s | peak host memory, MiB | peak device memory, MiB | copies, "
      "GB/s "
      "|\n|---|---|---|---|---|---|\n";
  for (const DeviceTimes& device : report.devices)
    text += fmt::format(
        "| {} | {} | {:.2f} | {:.0f} | {:.0f} | {} |\n", device.name, device.driver,
        images_per_second(device), static_cast<double>(device.peak_host_bytes) / MIB,
        static_cast<double>(device.peak_device_bytes) / MIB,
        device.copy_bytes_per_s > 0 ? fmt::format("{:.1f}", 1e-9 * device.copy_bytes_per_s) : "");
  return text;
}

bool works(const StageSamples& stage) { return stage.device.submits > 0; }

// What each stage asked of the device; empty for the CPU.
std::string work_table(const DeviceTimes& device) {
  if (std::ranges::none_of(device.stages, works)) return "";
  std::string text = fmt::format(
      "\n## Work of {}\n\nOf one repetition after the first ones. Allocations are of device "
      "memory.\n\n"
      "| stage | ms beside the kernels | submits | dispatches | MB up | MB down | MB filled | "
      "allocations |\n|---|---|---|---|---|---|---|---|\n",
      device.name);
  for (const StageSamples& stage : device.stages)
    text += fmt::format("| {} | {} | {} | {} | {:.2f} | {:.2f} | {:.2f} | {} |\n", stage.stage,
                        host_ms_text(stage), stage.device.submits, stage.device.dispatches,
                        megabytes(stage.device.bytes_up), megabytes(stage.device.bytes_down),
                        megabytes(stage.device.bytes_filled), stage.device.allocations);
  return text;
}

std::string kernel_table(const DeviceTimes& device) {
  std::string text = fmt::format(
      "\n## Kernels on {}\n\nThe floor is the time of copying as many bytes as the kernel must "
      "read and "
      "write at least; it is held against the kernel's own time (on a device by its clock, the "
      "mean; a call "
      "has "
      "uploads, submission and downloads in addition to it).\n\n"
      "| kernel | size | a call, median ms | kernel, ms | floor, ms | times floor "
      "|\n|---|---|---|---|---|---|\n",
      device.name);
  for (const bench::Row& kernel : device.kernels)
    text += fmt::format("| {} | {} | {:.3f} | {:.3f} | {:.3f} | {:.1f} |\n", kernel.kernel,
                        kernel.size, kernel.median_ms, kernel_ms(kernel), floor_ms(kernel, device),
                        times_floor(kernel, device));
  return text;
}

}  // namespace

std::string devices_json(const DevicesReport& report) {
  nlohmann::ordered_json json{{"commit", report.commit},
                              {"seed", report.options.seed},
                              {"repetitions", report.options.repetitions},
                              {"width", report.width},
                              {"height", report.height},
                              {"instances", report.instances},
                              {"poses", report.poses},
                              {"templates", report.templates},
                              {"threads", report.load.threads},
                              {"load_average", report.load.load_average},
                              {"processor_share", report.load.share},
                              {"processor_share_at_end", report.load_at_end.share},
                              {"machine", machine_name()},
                              {"warnings", report.warnings}};
  for (const auto& [name, value] : report.settings) json["options"][name] = value;
  for (const DeviceTimes& device : report.devices)
    json["devices"].push_back(device_json(device, report.devices[0]));
  return json_text(json);
}

std::string devices_markdown(const DevicesReport& report) {
  std::string text = fmt::format(
      "# Devices\n\nOne rendered image of {} x {} with {} instances of one part; {} templates; {} "
      "poses "
      "registered "
      "and scored; one decision among {} views with {} candidates, {} particles and {} "
      "combinations. "
      "Medians of {} "
      "repetitions (fewer where a device is slow), "
      "devices in turn within one run. {} threads, load average {:.2f}, {:.0f} % of the processors "
      "to be had "
      "before, {:.0f} % at the end. Seed {}, commit {}.\n\n",
      report.width, report.height, report.instances, report.templates, report.poses,
      DecisionSize{}.views, DecisionSize{}.candidates, DecisionSize{}.particles,
      DecisionSize{}.combinations, report.options.repetitions, report.load.threads,
      report.load.load_average, 100 * report.load.share, 100 * report.load_at_end.share,
      report.options.seed, report.commit);
  text += "Options: ";
  for (const auto& [name, value] : report.settings) text += fmt::format("{} {}, ", name, value);
  text += "on " + machine_name() + ".\n\n";
  for (const std::string& warning : report.warnings) text += "**Warning:** " + warning + "\n\n";
  text += stage_table(report) + "\n" + device_table(report);
  for (const DeviceTimes& device : report.devices) text += work_table(device);
  for (const DeviceTimes& device : report.devices)
    if (!device.kernels.empty()) text += kernel_table(device);
  return text;
}

}  // namespace edgescout
