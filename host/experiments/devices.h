// Every stage from an image to poses, and the decision where to look next, timed on every device
// beside the CPU in one run.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "host/experiments/machine.h"
#include "host/pipeline.h"
#include "kernels/cases/measure.h"

namespace edgescout {

struct DevicesOptions {
  std::vector<std::string> devices;  // as make_backend takes them; empty: cpu and every Vulkan
                                     // device. "cpu" is always among them, first
  int repetitions = 7;        // of every stage; a slow device gets fewer, but three
  double image_scale = 1;     // of 1024 x 768
  TemplateOptions templates;  // distances of 0: from those of the parts in the image
  PipelineOptions pipeline;
  unsigned seed = 1;      // of the image
  bool kernels = true;    // also every kernel on its own, against the device's copying speed
  void validate() const;  // InputError naming the field and the violated bound
};

// One stage on one device.
struct StageSamples {
  std::string stage;
  std::vector<double> ms;
  double median_ms() const;
};

struct DeviceTimes {
  std::string choice, name, driver;
  bool is_software =
      false;  // a rasteriser on the processor: right, but no measure of a graphics card
  // "edges", "tensors", "scan", "registration", "scoring", "next view", "image to poses"
  std::vector<StageSamples> stages;
  // of the whole process while an image was searched, with what the devices before it keep
  std::size_t peak_host_bytes = 0;
  std::size_t peak_device_bytes =
      0;  // in the device's buffers; part of the host's where memory is unified
  double copy_bytes_per_s = 0;  // read and written
  std::vector<bench::Row> kernels;
};

struct DevicesReport {
  MachineLoad load, load_at_end;                        // before and after everything was timed
  std::vector<std::string> warnings;                    // a busy machine, software devices
  int width = 0, height = 0, instances = 0, poses = 0;  // of the image; poses registered and scored
  std::size_t templates = 0;                            // that are searched for
  DevicesOptions options;
  std::string commit;
  std::vector<std::pair<std::string, std::string>> settings;  // every option with its value
  std::vector<DeviceTimes> devices;                           // the CPU first
};

// `progress` (may be empty) is called with repetitions done and in all.
DevicesReport time_devices(const DevicesOptions& options,
                           const std::function<void(std::size_t, std::size_t)>& progress);

std::string devices_json(const DevicesReport& report);
std::string devices_markdown(const DevicesReport& report);

}  // namespace edgescout
