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

// Whether a file's name has one of the endings of images that folders are searched for, in any
// case: those of all formats that OpenCV decodes.
bool has_image_extension(const std::filesystem::path& file);

// Whether a file of a folder is taken for an image: by the ending of its name, or by its first
// bytes.
bool is_image_file(const std::filesystem::path& file);

// Reads a grey image of 8 bit. The content decides about the format, not the name. Colour images
// and mosaics are converted. Deeper images are scaled as ImageOptions say (docs/images.md). Pixels
// are as stored, whatever an EXIF orientation says; of several pages the first is read. The first
// of each is logged. InputError: the file is missing, is not an image, has more than 2^28 pixels
// (found in the header, before it is decoded) or is smaller than 16 x 16 px.
Image load_image(const std::filesystem::path& file, const ImageOptions& options = {});

// The same of a file's content. `source` names it in errors.
Image decode_image(const std::string& bytes, const std::string& source,
                   const ImageOptions& options = {});

// The same of values in memory, row by row: of 16 bit, or real numbers. InputError: another number
// of values than the size says.
Image grey_image(std::span<const std::uint16_t> values, int width, int height,
                 const ImageOptions& options = {});
Image grey_image(std::span<const float> values, int width, int height,
                 const ImageOptions& options = {});

// How a camera's driver lays out pixels in memory, row by row.
struct PixelLayout {
  int width = 0, height = 0;
  std::size_t row_bytes = 0;  // from one row to the next
  int channels = 1;           // 1 grey or mosaic, 2 luma and chroma, 3 colour, 4 colour and other
  int channel_bytes = 1;      // 1 or 2
  bool is_luma_first = true;  // of 2 channels
  bool is_red_first = false;  // of 3 and 4; else blue is
  bool is_big_endian = false;
};
// The same of such pixels. The last row may lack its padding. InputError naming `source`: sides
// that load_image refuses, rows that are shorter than their pixels, another number of bytes, other
// channels.
Image grey_image(std::span<const std::uint8_t> bytes, const PixelLayout& layout,
                 const std::string& source, const ImageOptions& options = {});

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
