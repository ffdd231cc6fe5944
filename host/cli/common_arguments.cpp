#include "host/cli/common_arguments.h"

#include <spdlog/spdlog.h>

#include "host/cli/help.h"
#include "host/cli/option_table.h"

namespace edgescout {

void add_images(CLI::App& verb, std::vector<std::string>& inputs) {
  verb.add_option("inputs", inputs,
                  "Images, videos, folders of them, BOP scenes or folders of these")
      ->required();
}

void add_input_options(CLI::App& verb, InputOptions& options) {
  constexpr int most_frames = 1'000'000'000;
  CommandLineOptions add(verb);
  describe(options.images, add);
  OptionTable(verb, "Videos", OptionLevel::Expert)
      .bounded("every", options.every, 1, most_frames, "Take every Nth frame of videos")
      .bounded("first-frame", options.first_frame, 0, most_frames,
               "First frame of videos; the first one of the file is 0")
      .bounded("last-frame", options.last_frame, 0, most_frames, "Last frame of videos");
}

void add_camera(CLI::App& verb, CameraArguments& camera) {
  verb.add_option("--camera", camera.file,
                  "Calibration of the images: a file of ROS, OpenCV, Kalibr, COLMAP, BOP, MATLAB "
                  "and others (docs/cameras.md). BOP scenes have their own")
      ->type_name("FILE");
  add_camera_choice(verb, camera);
}

void add_camera_choice(CLI::App& verb, CameraArguments& camera) {
  CLI::Option* name =
      verb.add_option("--camera-name", camera.name,
                      "Which camera of the calibration's file, where it has several")
          ->type_name("NAME")
          ->group("Camera");
  mark_expert(verb, name);
  OptionTable(verb, "Camera", OptionLevel::Expert)
      .bounded("field-of-view", camera.field_of_view_deg, 0.0, 170.0,
               "Horizontal field of view of undistorted images, degrees. 0: they keep the "
               "calibration's focal lengths and principal point");
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

void add_max_seconds(CLI::App& verb, double& max_seconds) {
  OptionTable(verb, "Batch")
      .bounded("max-seconds", max_seconds, 0.0, 1e9,
               "Time for each image once its edges are found, or for each scene whose views are "
               "worked on together, s. Then the poses found so far are written. 0: no limit");
}

void add_thumbnails(CLI::App& verb, int& thumbnails) {
  OptionTable(verb, "Batch")
      .bounded("thumbnails", thumbnails, 0, 20000,
               "Images whose thumbnail is in report.html, at most. The overlays of the others are "
               "shown from their files");
}

void add_scale_camera(CLI::App& verb, bool& scale_camera) {
  OptionTable(verb, "Batch", OptionLevel::Expert)
      .flag("scale-camera", scale_camera,
            "Accept images of another size than the calibration's, with the same aspect ratio");
}

void add_detection_options(CLI::App& verb, TemplateOptions& templates, PipelineOptions& pipeline) {
  CommandLineOptions add(verb);
  describe(templates, add);
  describe(pipeline, add);
}

}  // namespace edgescout
