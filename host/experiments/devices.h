// Times every stage from an image to poses, and the decision on the next view, on the CPU and on
// every other device in one run.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "host/experiments/machine.h"
#include "host/pipeline.h"
#include "kernels/cases/measure.h"

namespace edgescout {

struct DevicesOptions {
  // As make_backend takes them. Empty: cpu and every Vulkan device. "cpu" is always the first.
  std::vector<std::string> devices;
  int repetitions = 7;        // of every stage; a slow device gets fewer, but at least three
  double image_scale = 1;     // of 1024 x 768
  TemplateOptions templates;  // distances of 0: taken from the parts in the image
  PipelineOptions pipeline;
  unsigned seed = 1;      // of the image
  bool kernels = true;    // also times every kernel, compared with the device's copying speed
  void validate() const;  // InputError naming the field and the violated bound
};

inline constexpr const char* IMAGE_TO_POSES = "image to poses";

// One stage on one device.
struct StageSamples {
  std::string stage;
  std::vector<double> ms;
  // Of them, what the device's kernels did not take. Empty where these were not timed.
  std::vector<double> host_ms = {};
  DeviceWork device = {};  // of the last repetition
  double median_ms() const;
};

struct DeviceTimes {
  std::string choice, name, driver;
  bool is_software = false;  // runs on the processor: its times say nothing of a graphics card
  // "edges", "tensors", "scan", "registration", "scoring", "next view", IMAGE_TO_POSES, and the
  // stages of which that consists, as "image to poses: scan"
  std::vector<StageSamples> stages;
  // Of the whole process during one image, with the memory that earlier devices keep.
  std::size_t peak_host_bytes = 0;
  // In the device's buffers. With unified memory they are part of the host's bytes.
  std::size_t peak_device_bytes = 0;
  double copy_bytes_per_s = 0;  // read and written
  std::vector<bench::Row> kernels;
};

struct DevicesReport {
  MachineLoad load, load_at_end;             // before and after all measurements
  std::vector<std::string> warnings;         // a busy machine, software devices
  int width = 0, height = 0, instances = 0;  // of the image
  int poses = 0;                             // that are registered and scored
  std::size_t templates = 0;                 // in the scan
  DevicesOptions options;
  std::string commit;
  std::vector<std::pair<std::string, std::string>> settings;  // every option with its value
  std::vector<DeviceTimes> devices;                           // the CPU first
};

// `progress` (may be empty) is called with the repetitions done and their total.
DevicesReport time_devices(const DevicesOptions& options,
                           const std::function<void(std::size_t, std::size_t)>& progress);

std::string devices_json(const DevicesReport& report);
std::string devices_markdown(const DevicesReport& report);

}  // namespace edgescout
