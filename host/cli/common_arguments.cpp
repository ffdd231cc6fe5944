#include "host/cli/common_arguments.h"

#include <spdlog/spdlog.h>

#include "host/cli/option_table.h"

namespace edgescout {

void add_images(CLI::App& verb, std::vector<std::string>& inputs) {
  verb.add_option("inputs", inputs, "Images, folders of images, BOP scenes or folders of them")
      ->required();
}

void add_camera_file(CLI::App& verb, std::string& file) {
  verb.add_option("--camera", file,
                  "Calibration of the images: ROS or OpenCV YAML, or BOP camera JSON. BOP scenes "
                  "have their own")
      ->type_name("FILE");
}

void add_results_folder(CLI::App& verb, std::string& out) {
  verb.add_option("--out", out, "Folder of the results")->required()->type_name("DIR");
}

void add_device(CLI::App& verb, std::string& device) {
  verb.add_option("--device", device,
                  "Device to compute on: auto, cpu, cpu-reference, vulkan or vulkan:INDEX")
      ->capture_default_str();
}

std::unique_ptr<Backend> backend_of(const std::string& device) {
  return make_backend(device, {.time_kernels = spdlog::should_log(spdlog::level::debug)});
}

void add_scale_camera(CLI::App& verb, bool& scale_camera) {
  OptionTable(verb, "Batch", OptionLevel::Expert)
      .flag("scale-camera", scale_camera,
            "Accept images of another size than the calibration's, with the same aspect ratio");
}

void add_detection_options(CLI::App& verb, TemplateOptions& templates, PipelineOptions& pipeline) {
  CommandLineOptions add(verb);
  describe(templates, add);
  describe(pipeline.edges, add);
  describe(pipeline.tensor, add);
  describe(pipeline.detect, add);
  describe(pipeline.detect.scan.world, add);
  describe(pipeline.detect.edge_claims, add);
}

}  // namespace edgescout
