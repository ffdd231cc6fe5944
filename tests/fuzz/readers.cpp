#include "tests/fuzz/readers.h"

#include <CLI/CLI.hpp>
#include <fstream>

#include "host/active/scout_state.h"
#include "host/cli/config.h"
#include "host/cli/option_table.h"
#include "host/core/camera_check.h"
#include "host/io/bop.h"
#include "host/io/bop_targets.h"
#include "host/io/camera_file.h"
#include "host/io/exif.h"
#include "host/io/files.h"
#include "host/io/image_header.h"
#include "host/io/mesh.h"
#include "host/io/one_line.h"
#include "host/io/png_chunks.h"
#include "host/io/poses.h"
#include "host/io/tiff_header.h"
#include "host/model/template_set.h"
#include "kernels/error.h"

namespace edgescout::test {

namespace {

namespace fs = std::filesystem;

void read_mesh(const fs::path& file) { load_mesh(file, LengthUnit::Millimetre); }

void read_calibration(const fs::path& file) {
  for (const FileCamera& found : load_cameras(file)) implausible_in(found.camera);
}

void read_scene(const fs::path& file) { load_bop_scene(file.parent_path()); }

// A scene needs its cameras; the file given holds other things of it.
void read_scene_with_camera(const fs::path& file) {
  const fs::path camera = file.parent_path() / "scene_camera.json";
  if (!fs::exists(camera))
    std::ofstream(camera) << R"({"0": {"cam_K": [500, 0, 320, 0, 500, 240, 0, 0, 1]},
                                 "1": {"cam_K": [500, 0, 320, 0, 500, 240, 0, 0, 1]}})";
  read_scene(file);
}

// Few steps: the number of samples is the caller's choice, not the file's.
void read_symmetries(const fs::path& file) { load_symmetries(file, 4); }

// What is read of an image before OpenCV decodes it.
void read_image_header(const fs::path& file) {
  const std::string bytes = read_file(file);
  exif_orientation(bytes);
  stated_size(bytes);
  has_more_pages(bytes);
  stated_bytes(bytes);
  stated_white(bytes);
  undecodable(bytes);
  as_stored(bytes);
  needed_png_chunks(bytes, file.string());
}

// A program with a verb that has options of every kind.
void read_options(const fs::path& file) {
  CLI::App program("program", "program");
  add_yaml_config(program);
  bool flag = true;
  std::string device;
  program.add_option("--device", device);
  CLI::App* verb = program.add_subcommand("detect");
  std::vector<std::string> inputs;
  verb->add_option("inputs", inputs);
  TemplateOptions templates;
  CommandLineOptions options(*verb);
  describe(templates, options);
  OptionTable(*verb, "Batch").flag("resume,!--no-resume", flag, "a flag");
  try {
    program.parse("--config \"" + file.string() + "\" detect");
  } catch (const CLI::ParseError& error) {
    throw InputError(file.string() + ": " + one_line(error.what()));  // as the program prints it
  }
}

constexpr FuzzedReader all[] = {
    {"stl", "x.stl", read_mesh},
    {"ply", "x.ply", read_mesh},
    {"obj", "x.obj", read_mesh},
    {"off", "x.off", read_mesh},
    {"cao", "x.cao", read_mesh},
    {"camera_text", "x.yaml", read_calibration},
    {"camera_json", "x.json", read_calibration},
    {"poses", "x.json", [](const fs::path& file) { load_start_poses(file); }},
    {"targets", "x.json", [](const fs::path& file) { load_bop_targets(file); }},
    {"results", "x.csv", [](const fs::path& file) { load_bop_results(file); }},
    {"bop_camera", "scene_camera.json", read_scene},
    {"bop_truth", "scene_gt.json", read_scene_with_camera},
    {"bop_models", "models_info.json", read_symmetries},
    {"templates", "x.templates", [](const fs::path& file) { load_templates(file); }, true},
    {"scout_state", "x.state", [](const fs::path& file) { load_scout_state(file); }, true},
    {"options", "x.yaml", read_options},
    {"image", "x.jpg", read_image_header},
};

}  // namespace

std::span<const FuzzedReader> fuzzed_readers() { return all; }

}  // namespace edgescout::test
