// Internal to host/io: the stored values of an image file, of any type and number of channels.
#pragma once

#include <filesystem>
#include <opencv2/core.hpp>
#include <string>

#include "host/io/image_options.h"

namespace edgescout {

// InputError: the file is missing or larger than 2^31 bytes.
std::string read_image_bytes(const std::filesystem::path& file);

// Values as stored. InputError naming `source`: no image, one that is cut short, more than 2^28
// pixels (found in the header, before it is decoded).
cv::Mat decode_pixels(const std::string& bytes, const ImageOptions& options,
                      const std::string& source);

}  // namespace edgescout
