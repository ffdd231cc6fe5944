// --depth and what belongs to it: which depth image belongs to which grey image.
#pragma once

#include <CLI/CLI.hpp>
#include <filesystem>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "host/io/depth_options.h"
#include "host/io/depth_registration.h"
#include "host/register/measured_depth.h"

namespace edgescout {

struct BopImage;
struct InputImage;

inline constexpr char DEPTH_OF_SCENES[] = "scene";

struct DepthArguments {
  std::string from;    // DEPTH_OF_SCENES: that of BOP scenes; a file; a folder; empty: no depth
  std::string camera;  // calibration file; empty: depth images have the camera of the grey ones
  std::vector<double> pose;  // camera_from_depth: x y z, m, and a quaternion x y z w
  DepthOptions options;
};

// --depth, --depth-camera, --depth-pose and the options of the struct.
void add_depth(CLI::App& verb, DepthArguments& depth);
// InputError: an option of the groups "Depth" and "Depth sensor" was given, and not --depth.
void refuse_options_without_depth(const CLI::App& verb);

// The depth image of one input image.
struct DepthFile {
  std::filesystem::path file;
  std::optional<double> unit_m;  // as the dataset states it
};
std::optional<DepthFile> depth_file_of(const BopImage& image);  // nothing where it has none

// Sets InputImage::depth of all images that have some. InputError: a file for several images, a
// folder that is not there, a BOP scene's depth for other images, no depth for any image.
void find_depth(std::span<InputImage> images, const DepthArguments& arguments);

// Reads depth images, each with the camera of its grey image.
class DepthReader {
 public:
  // InputError: --depth-camera or --depth-pose that cannot be read.
  explicit DepthReader(const DepthArguments& arguments);
  // Null where the image has no depth. `camera` is that of the grey image. InputError: as
  // load_depth and undistort_depth.
  std::shared_ptr<const MeasuredDepth> read(const InputImage& input, const Camera& camera,
                                            ThreadPool& pool) const;

 private:
  std::optional<DepthCamera> camera_of(const DepthImage& stored) const;

  DepthOptions options_;
  std::optional<DepthCamera> own_camera_;
  std::string camera_file_;
};

}  // namespace edgescout
