// Images from and to files, and the one place where lens distortion is taken out.
#pragma once

#include <filesystem>
#include <string>

#include "host/core/types.h"

namespace edgescout {

// Grey, 8 bit. A colour image is converted (and logged once as Info). InputError: missing, not an
// image, 16 bit, smaller than 16 x 16 px.
Image load_image(const std::filesystem::path& file);

// Resamples an image of `camera` into that of undistorted(camera), bicubic; returns it unchanged
// where there is no distortion. Pixels that no ray of the original reaches repeat its border.
// InputError: another number of pixels than its size says; distortion in an image with a side above
// 32766 px. LogicError: an image of another size than the camera's.
Image undistort(const Image& image, const Camera& camera);

// RGB, 8 bit, row-major.
struct RgbImage {
  int width = 0;
  int height = 0;
  std::vector<std::uint8_t> pixels;
};
// A PNG file's bytes. LogicError: another number of pixels than the size says.
std::string encode_png(const RgbImage& image);
std::string encode_png(const Image& image);
void save_png(const RgbImage& image, const std::filesystem::path& file);  // atomically
void save_png(const Image& image, const std::filesystem::path& file);

}  // namespace edgescout
