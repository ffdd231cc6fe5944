#include "host/bindings/python/src/array_pixels.h"

#include <cstdlib>
#include <new>
#include <optional>

#include "host/bindings/python/src/interrupt.h"
#include "host/io/depth_file.h"
#include "host/io/pixels.h"

namespace edgescout::python {

namespace {

// Pixels and the array whose memory they are.
struct ArrayPixels {
  py::array array;
  Pixels pixels;
};

py::array array_of_numbers(const py::handle& value, const std::string& name) {
  auto array = array_like<py::array>(value, name);
  if (array.dtype().kind() == 'O') refuse_no_array(value, name);
  return array;
}

// Values of a pixel; 0: no image.
py::ssize_t channels_of(const py::array& array) {
  if (array.ndim() == 2) return 1;
  return array.ndim() == 3 ? array.shape(2) : 0;
}

std::optional<PixelFormat> format_of(const py::array& array) {
  struct Known {
    char kind;
    py::ssize_t value_bytes, channels;
    PixelFormat format;
  };
  constexpr Known formats[] = {
      {'u', 1, 1, PixelFormat::Mono8},       {'u', 1, 3, PixelFormat::Rgb8},
      {'u', 1, 4, PixelFormat::Rgba8},       {'u', 2, 1, PixelFormat::Mono16},
      {'u', 2, 3, PixelFormat::Rgb16},       {'u', 2, 4, PixelFormat::Rgba16},
      {'f', 4, 1, PixelFormat::MonoFloat32}, {'u', 4, 1, PixelFormat::MonoUint32},
  };
  for (const Known& known : formats)
    if (known.kind == array.dtype().kind() && known.value_bytes == array.itemsize() &&
        known.channels == channels_of(array))
      return known.format;
  return {};
}

// Whether colours of three values stand from the last to the first in memory.
bool is_reversed(const py::array& array) {
  return array.ndim() == 3 && array.shape(2) == 3 && array.strides(2) == -array.itemsize();
}

// Whether the pixels of a row follow one another, and rows do not overlap.
bool has_whole_rows(const py::array& array) {
  const py::ssize_t pixel_bytes = channels_of(array) * array.itemsize();
  return array.strides(1) == pixel_bytes &&
         std::abs(array.strides(0)) >= array.shape(1) * pixel_bytes &&
         (channels_of(array) == 1 || array.strides(2) == array.itemsize() || is_reversed(array));
}

// The format of which the array's is the reverse.
PixelFormat reversed(PixelFormat format) {
  return format == PixelFormat::Rgb8 ? PixelFormat::Bgr8 : PixelFormat::Bgr16;
}

ArrayPixels pixels_of(const py::array& array, PixelFormat format, const std::string& name) {
  constexpr py::ssize_t most_pixels = py::ssize_t(1) << 28;
  if (array.size() == 0) refuse(name, found(array), "pixels");
  if (array.shape(0) > most_pixels / array.shape(1))
    refuse(name, found(array), "at most 2^28 pixels");
  ArrayPixels taken{array, {nullptr, int(array.shape(1)), int(array.shape(0)), 0, format}};
  taken.pixels.has_swapped_bytes = !py::cast<bool>(array.dtype().attr("isnative"));
  if (has_whole_rows(array)) {
    taken.pixels.row_stride_bytes = array.strides(0);
  } else {
    taken.array = py::array::ensure(array, py::array::c_style);
    if (!taken.array) throw std::bad_alloc();
  }
  const auto* first = static_cast<const std::byte*>(taken.array.data());
  if (is_reversed(taken.array)) {
    first += 2 * taken.array.strides(2);
    taken.pixels.format = reversed(format);
  }
  taken.pixels.first_row = first;
  return taken;
}

}  // namespace

Image image_of(const py::handle& value, const ImageOptions& options) {
  const py::array array = array_of_numbers(value, "image");
  const std::optional<PixelFormat> format = format_of(array);
  if (!format || *format == PixelFormat::MonoUint32)
    refuse("image", found(array),
           "uint8 or uint16 of shape (height, width) or (height, width, 3 or 4), or float32 of "
           "shape (height, width)");
  const ArrayPixels taken = pixels_of(array, *format, "image");
  return without_lock([&] { return grey_image(taken.pixels, options); });
}

DepthImage depth_of(const py::handle& value, const DepthOptions& options) {
  const py::array array = array_of_numbers(value, "depth");
  const std::optional<PixelFormat> format = array.ndim() == 2 ? format_of(array) : std::nullopt;
  if (format != PixelFormat::Mono16 && format != PixelFormat::MonoUint32 &&
      format != PixelFormat::MonoFloat32)
    refuse("depth", found(array), "uint16 or uint32 (mm) or float32 (m) of shape (height, width)");
  const ArrayPixels taken = pixels_of(array, *format, "depth");
  return without_lock([&] { return depth_image(taken.pixels, options, "depth"); });
}

}  // namespace edgescout::python
