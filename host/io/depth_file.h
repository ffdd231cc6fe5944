// Reads depth images: 16 bit PNG (BOP, ROS, OpenNI), real numbers in TIFF, PFM or OpenEXR.
//
// Public header.
#pragma once

#include <filesystem>
#include <optional>
#include <span>
#include <string>

#include "host/core/depth_image.h"
#include "host/io/depth_options.h"
#include "host/io/pixels.h"

namespace edgescout {

// Reads a depth image. Stored values are camera-frame z in units of options.unit_m, or where that
// is 0 of `stated_m` (BOP's depth_scale), or else of 1 mm for whole numbers and 1 m for real ones.
// 0, NaN, infinity and values outside options.range_m become DEPTH_MISSING. InputError naming the
// file: missing, no image, several channels, 8 bit, or values none of which lies inside the range
// (the message names their median, which tells a wrong unit). A depth image without any value is no
// error.
DepthImage load_depth(const std::filesystem::path& file, const DepthOptions& options = {},
                      std::optional<double> stated_m = {});

// Reads the depth image of a file's content. `source` names it in errors.
DepthImage decode_depth(const std::string& bytes, const std::string& source,
                        const DepthOptions& options = {}, std::optional<double> stated_m = {});

// Makes a depth image of values in memory, row by row (ROS: 16UC1, 32FC1). InputError: another
// number of values than the size says.
DepthImage depth_image(std::span<const std::uint16_t> values, int width, int height,
                       const DepthOptions& options = {}, std::optional<double> stated_m = {});
DepthImage depth_image(std::span<const float> values, int width, int height,
                       const DepthOptions& options = {}, std::optional<double> stated_m = {});

// Makes a depth image of pixels in memory: Mono16, MonoUint32 or MonoFloat32, of any stride.
// `source` names them in errors. InputError, beside those above: another format, a stride that is
// shorter than a row.
DepthImage depth_image(const Pixels& pixels, const DepthOptions& options = {},
                       const std::string& source = "depth image");

}  // namespace edgescout
