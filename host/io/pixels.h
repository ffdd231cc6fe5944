// Grey images of pixels that lie in a camera driver's or another program's memory.
//
// Public header.
#pragma once

#include <cstddef>
#include <string>

#include "host/core/types.h"
#include "host/io/image_options.h"

namespace edgescout {

// Bytes of a pixel in the order of its name. Of video formats (Y U Y V, U Y V Y) Y is used. Bayer
// patterns are named by the first two pixels of the first two rows.
enum class PixelFormat {
  Mono8,
  Mono16,
  MonoFloat32,
  Bgr8,
  Rgb8,
  Bgra8,
  Rgba8,
  BayerRggb8,
  BayerBggr8,
  BayerGrbg8,
  BayerGbrg8,
  BayerRggb16,
  BayerBggr16,
  BayerGrbg16,
  BayerGbrg16,
  Bgr16,
  Rgb16,
  Bgra16,
  Rgba16,
  Yuyv8,
  Uyvy8,
  MonoUint32,  // of depth images alone
};
inline constexpr int PIXEL_FORMATS = 22;
int bytes_per_pixel(PixelFormat format);

// Pixels of the caller. Rows may be padded, begin at any address, or go upwards in memory (a
// negative stride; `first_row` is that of the upper border of the image).
struct Pixels {
  const void* first_row = nullptr;
  int width = 0, height = 0;
  std::ptrdiff_t row_stride_bytes = 0;  // 0: rows follow one another
  PixelFormat format = PixelFormat::Mono8;
  bool has_swapped_bytes = false;  // values are not as this machine orders their bytes
};

// Returns the image that load_image makes of a file of these pixels. `source` names them in errors.
// InputError: no pixels, less than 16x16 or more than 2^28 of them, a stride that is shorter than a
// row; a pattern in the options beside one in the format; a format of depth images alone.
Image grey_image(const Pixels& pixels, const ImageOptions& options = {},
                 const std::string& source = "image");

}  // namespace edgescout
