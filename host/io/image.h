// Reads and writes images, and removes lens distortion. No other code handles distorted images.
//
// Public header.
#pragma once

#include <filesystem>
#include <span>
#include <string>

#include "host/core/types.h"
#include "host/io/image_options.h"

namespace edgescout {

// Returns whether a file's name has one of the endings of images that folders are searched for, in
// any case: those of all formats that OpenCV decodes.
bool has_image_extension(const std::filesystem::path& file);

// Returns whether a file of a folder is taken for an image: by the ending of its name, or by its
// first bytes.
bool is_image_file(const std::filesystem::path& file);

// Reads a grey image of 8 bit. The content decides about the format, not the name. Colour images
// and mosaics are converted. Deeper images are scaled as ImageOptions say (docs/images.md). Pixels
// are as stored, whatever an EXIF orientation says; of several pages the first is read. The first
// of each is logged. InputError: the file is missing, is not an image, has more than 2^28 pixels
// (found in the header, before it is decoded) or is smaller than 16 x 16 px.
Image load_image(const std::filesystem::path& file, const ImageOptions& options = {});

// Reads the grey image of a file's content. `source` names it in errors.
Image decode_image(const std::string& bytes, const std::string& source,
                   const ImageOptions& options = {});

// Makes a grey image of values in memory, row by row: of 16 bit, or real numbers. InputError:
// another number of values than the size says.
Image grey_image(std::span<const std::uint16_t> values, int width, int height,
                 const ImageOptions& options = {});
Image grey_image(std::span<const float> values, int width, int height,
                 const ImageOptions& options = {});

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
