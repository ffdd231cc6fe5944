// Arguments that several verbs have, declared once.
#pragma once

#include <CLI/CLI.hpp>
#include <memory>
#include <string>
#include <vector>

#include "host/cli/inputs.h"
#include "host/pipeline.h"

namespace edgescout {

// For the help of options that name CAD files and their unit.
inline const std::string MESH_FORMATS = "STL, PLY, OBJ, OFF, CAO, glTF, 3MF or COLLADA",
                         UNIT_HELP =
                             "Length unit of the model files: mm, cm, m or in. glTF, 3MF and "
                             "COLLADA state one, which is used without it";

void add_images(CLI::App& verb, std::vector<std::string>& inputs);  // required
// How images are read, and which frames of videos: --bayer, --image-range, --every ..
void add_input_options(CLI::App& verb, InputOptions& options);
// --camera, --camera-name, --field-of-view
void add_camera(CLI::App& verb, CameraArguments& camera);
void add_camera_choice(CLI::App& verb, CameraArguments& camera);  // the last two
void add_results_folder(CLI::App& verb, std::string& out);        // --out, required
void add_device(CLI::App& verb, std::string& device);             // --device; shows its default
void add_max_seconds(CLI::App& verb, double& max_seconds);        // --max-seconds
void add_thumbnails(CLI::App& verb, int& thumbnails);             // --thumbnails
void add_scale_camera(CLI::App& verb, bool& scale_camera);        // --scale-camera

// The backend of --device. Its kernels are timed where the log shows their times.
std::unique_ptr<Backend> backend_of(const std::string& device);

// Templates, edges, tensor and detection of single images.
void add_detection_options(CLI::App& verb, TemplateOptions& templates, PipelineOptions& pipeline);

}  // namespace edgescout
