#include "host/cli/depth_input.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>

#include "host/cli/inputs.h"
#include "host/cli/option_table.h"
#include "host/core/log.h"
#include "host/io/bop.h"
#include "host/io/camera_file.h"
#include "host/io/depth_file.h"
#include "host/io/image.h"
#include "kernels/error.h"

namespace edgescout {

namespace fs = std::filesystem;

namespace {

void find_in_folder(std::span<InputImage> images, const fs::path& folder) {
  std::map<std::string, fs::path> by_stem;
  std::error_code failure;
  for (fs::directory_iterator entry(folder, failure), end; !failure && entry != end;
       entry.increment(failure))
    if (has_image_extension(entry->path())) by_stem[entry->path().stem().string()] = entry->path();
  if (failure)
    throw InputError(folder.string(), "--depth", failure.message(), "a folder that can be read");
  for (InputImage& image : images) {
    const auto found = by_stem.find(image.file.stem().string());
    if (found != by_stem.end()) image.depth = DepthFile{found->second, {}};
  }
}

Se3 pose_of(const std::vector<double>& numbers) {
  if (numbers.empty()) return {};
  const Eigen::Quaterniond rotation(numbers[6], numbers[3], numbers[4], numbers[5]);
  constexpr double tolerance = 0.01;
  if (!(std::abs(rotation.norm() - 1) < tolerance))
    throw InputError("command line", "--depth-pose",
                     fmt::format("a quaternion of length {:.4g}", rotation.norm()),
                     "one of length 1: x y z, m, then qx qy qz qw");
  return {rotation.normalized(), {numbers[0], numbers[1], numbers[2]}};
}

}  // namespace

void add_depth(CLI::App& verb, DepthArguments& depth) {
  verb.add_option(
          "--depth", depth.from,
          "Depth images beside the grey ones. scene: those of BOP scenes (depth/). A folder "
          "with files of the images' names, or the file of a single image: 16 bit, mm, or "
          "real numbers, m")
      ->type_name("FROM")
      ->group("Depth");
  verb.add_option("--depth-camera", depth.camera,
                  "Calibration of the depth images, where they have another camera than the grey "
                  "ones")
      ->type_name("FILE")
      ->group("Depth");
  CommandLineOptions add(verb);
  add.group("Depth");
  add.numbers({"depth-pose",
               "Pose of the depth camera in the frame of the grey one: x y z, m, and a quaternion "
               "x y z w"},
              depth.pose, 7, -10, 10);
  describe(depth.options, add);
}

void refuse_options_without_depth(const CLI::App& verb) {
  if (verb.count("--depth") > 0) return;
  for (const CLI::Option* option : verb.get_options()) {
    const std::string& group = option->get_group();
    if (option->count() > 0 && (group == "Depth" || group == "Depth sensor"))
      throw InputError("command line", option->get_name(), "it without --depth", "--depth");
  }
}

std::optional<DepthFile> depth_file_of(const BopImage& image) {
  if (image.depth_file.empty()) return {};
  return DepthFile{image.depth_file, image.depth_unit_m()};
}

void find_depth(std::span<InputImage> images, const DepthArguments& arguments) {
  if (arguments.from != DEPTH_OF_SCENES)
    for (InputImage& image : images) image.depth.reset();
  if (arguments.from.empty()) return;
  std::error_code unknown;
  if (arguments.from == DEPTH_OF_SCENES) {
    for (InputImage& image : images)
      if (image.scene_folder.empty())
        throw InputError(image.file.string(), "--depth", "scene for an image of no BOP scene",
                         "a file or a folder of depth images");
  } else if (fs::is_directory(arguments.from, unknown)) {
    find_in_folder(images, arguments.from);
  } else if (images.size() == 1) {
    images[0].depth = DepthFile{arguments.from, {}};
  } else {
    throw InputError("command line", "--depth", arguments.from + " for several images",
                     "a folder of depth images, or scene");
  }
  const auto without = std::size_t(
      std::ranges::count_if(images, [](const InputImage& image) { return !image.depth; }));
  if (without == images.size())
    throw InputError("command line", "--depth", arguments.from + " without any depth image",
                     arguments.from == DEPTH_OF_SCENES ? "scenes with depth/"
                                                       : "files with the names of the images");
  if (without > 0)
    log(LogLevel::Warning,
        fmt::format("{} of {} images have no depth image", without, images.size()));
}

DepthReader::DepthReader(const DepthArguments& arguments) : options_(arguments.options) {
  options_.validate();
  if (arguments.camera.empty()) {
    if (!arguments.pose.empty())
      throw InputError("command line", "--depth-pose", "it without --depth-camera",
                       "the calibration of the depth images");
    return;
  }
  own_camera_ = DepthCamera{load_camera(arguments.camera), pose_of(arguments.pose)};
  camera_file_ = arguments.camera;
}

std::shared_ptr<const MeasuredDepth> DepthReader::read(const InputImage& input,
                                                       const Camera& camera,
                                                       ThreadPool& pool) const {
  if (!input.depth) return nullptr;
  const DepthImage stored = load_depth(input.depth->file, options_, input.depth->unit_m);
  return naming(input, [&] {
    return std::make_shared<const MeasuredDepth>(
        MeasuredDepth{in_grey_camera(stored, camera_of(stored), camera, pool), options_.noise});
  });
}

std::optional<DepthCamera> DepthReader::camera_of(const DepthImage& stored) const {
  if (!own_camera_) return {};
  return DepthCamera{
      camera_for_image(own_camera_->camera, stored.width, stored.height, false, camera_file_),
      own_camera_->grey_from_depth};
}

}  // namespace edgescout
