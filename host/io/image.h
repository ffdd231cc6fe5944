// Reads and writes images, and removes lens distortion. No other code handles distorted images.
//
// Public header.
#pragma once

#include <filesystem>
#include <string>

#include "host/core/types.h"

namespace edgescout {

// Whether a file's name ends as those of images that folders are searched for: png, jpg, jpeg, pgm,
// ppm, bmp, tif or tiff, in any case.
bool has_image_extension(const std::filesystem::path& file);

// Reads a grey image of 8 bit. A colour image is converted. An image of 16 bit is scaled: the value
// below which 0.1 % of its pixels lie becomes 0, that above which 0.1 % lie 255; a smaller range
// than 255 is only shifted. Pixels are as stored, whatever an EXIF orientation says. The first of
// each is logged. InputError: the file is missing, is not an image, has another bit depth or is
// smaller than 16 x 16 px.
Image load_image(const std::filesystem::path& file);

// Resamples an image of `camera` into an image of undistorted(camera), bicubic. Without distortion
// the image is returned unchanged. Pixels that no ray of the original reaches repeat its border.
// InputError: the number of pixels disagrees with the image's size, or an image with distortion has
// a side above 32766 px. LogicError: the image and the camera differ in size.
Image undistort(const Image& image, const Camera& camera);

// RGB, 8 bit, row-major.
struct RgbImage {
  int width = 0;
  int height = 0;
  std::vector<std::uint8_t> pixels;
};
// Returns the bytes of a PNG file. LogicError: the number of pixels disagrees with the size.
std::string encode_png(const RgbImage& image);
std::string encode_png(const Image& image);
void save_png(const RgbImage& image, const std::filesystem::path& file);  // atomically
void save_png(const Image& image, const std::filesystem::path& file);

}  // namespace edgescout
