#include "host/bridge/ros2/image_message.h"

#include <algorithm>
#include <bit>
#include <iterator>
#include <optional>

#include "host/bridge/ros2/frames.h"
#include "host/io/pixels.h"
#include "kernels/error.h"

namespace edgescout::ros2 {

namespace {

struct Encoding {
  const char* name;
  PixelFormat format;
  BayerPattern bayer = BayerPattern::None;  // of a mosaic
};

// sensor_msgs/image_encodings.hpp.
constexpr Encoding encodings[] = {
    {"mono8", PixelFormat::Mono8},
    {"mono16", PixelFormat::Mono16},
    {"bgr8", PixelFormat::Bgr8},
    {"rgb8", PixelFormat::Rgb8},
    {"bgra8", PixelFormat::Bgra8},
    {"rgba8", PixelFormat::Rgba8},
    {"bgr16", PixelFormat::Bgr16},
    {"rgb16", PixelFormat::Rgb16},
    {"bgra16", PixelFormat::Bgra16},
    {"rgba16", PixelFormat::Rgba16},
    {"bayer_rggb8", PixelFormat::BayerRggb8, BayerPattern::RGGB},
    {"bayer_bggr8", PixelFormat::BayerBggr8, BayerPattern::BGGR},
    {"bayer_gbrg8", PixelFormat::BayerGbrg8, BayerPattern::GBRG},
    {"bayer_grbg8", PixelFormat::BayerGrbg8, BayerPattern::GRBG},
    {"bayer_rggb16", PixelFormat::BayerRggb16, BayerPattern::RGGB},
    {"bayer_bggr16", PixelFormat::BayerBggr16, BayerPattern::BGGR},
    {"bayer_gbrg16", PixelFormat::BayerGbrg16, BayerPattern::GBRG},
    {"bayer_grbg16", PixelFormat::BayerGrbg16, BayerPattern::GRBG},
    {"yuv422", PixelFormat::Uyvy8},
    {"uyvy", PixelFormat::Uyvy8},
    {"yuv422_yuy2", PixelFormat::Yuyv8},
    {"yuyv", PixelFormat::Yuyv8},
    {"8UC1", PixelFormat::Mono8},  // OpenCV's: colours are in its own order
    {"8UC3", PixelFormat::Bgr8},
    {"8UC4", PixelFormat::Bgra8},
    {"16UC1", PixelFormat::Mono16},
    {"16UC3", PixelFormat::Bgr16},
    {"16UC4", PixelFormat::Bgra16},
    {"32FC1", PixelFormat::MonoFloat32},
};

std::optional<Encoding> encoding_named(const std::string& name) {
  const auto found = std::ranges::find_if(
      encodings, [&](const Encoding& encoding) { return encoding.name == name; });
  return found == std::end(encodings) ? std::nullopt : std::optional(*found);
}

// What a mosaic is by its message counts more than the options, which are of all images.
ImageOptions with_pattern(ImageOptions options, BayerPattern pattern) {
  if (pattern != BayerPattern::None) options.bayer = pattern;
  return options;
}

// The last row may lack its padding.
void require_bytes(const msg::Image& message, PixelFormat format, const std::string& source) {
  const std::uint64_t row = std::uint64_t(message.width) * std::uint64_t(bytes_per_pixel(format));
  if (message.step < row)
    throw InputError(source, "step", std::to_string(message.step) + " bytes a row",
                     "at least " + std::to_string(row));
  const std::uint64_t most = std::uint64_t(message.step) * message.height,
                      least = most - (message.height > 0 ? message.step - row : 0);
  if (message.data.size() < least || message.data.size() > most)
    throw InputError(source, "data", std::to_string(message.data.size()) + " bytes",
                     std::to_string(most) + " for " + std::to_string(message.width) + "x" +
                         std::to_string(message.height) + " px");
}

Image image_of(const msg::Image& message, const std::string& source, const ImageOptions& options) {
  const std::optional<Encoding> encoding = encoding_named(message.encoding);
  if (!encoding)
    throw InputError(source, "encoding", shown(message.encoding),
                     "mono8, mono16, bgr8, rgb8, bgra8, rgba8, their 16-bit forms, bayer_..8 or "
                     "..16, yuv422, yuv422_yuy2, 8UC1 to 8UC4, 16UC1 to 16UC4 or 32FC1");
  ImageOptions used = options;
  if (encoding->bayer != BayerPattern::None) used.bayer = BayerPattern::None;  // the format has it
  return grey_image(pixels_of(message, encoding->format, source), used, source);
}

// "bayer_rggb8; png compressed": what image_transport compressed, and how. A JPEG of a mosaic is in
// colour already, and says so: "bayer_rggb8; jpeg compressed bgr8".
Image image_of(const msg::CompressedImage& message, const std::string& source,
               const ImageOptions& options) {
  const std::string& format = message.format;
  if (format.find("compressedDepth") != std::string::npos)
    throw InputError(source, "format", shown(format), "a picture, not distances");
  const std::optional<Encoding> encoding = encoding_named(format.substr(0, format.find(';')));
  const bool is_mosaic = encoding && format.find("jpeg") == std::string::npos &&
                         format.find("compressed bgr") == std::string::npos &&
                         format.find("compressed rgb") == std::string::npos;
  return decode_image(std::string(message.data.begin(), message.data.end()), source,
                      is_mosaic ? with_pattern(options, encoding->bayer) : options);
}

}  // namespace

Pixels pixels_of(const msg::Image& message, PixelFormat format, const std::string& source) {
  require_bytes(message, format, source);
  constexpr bool is_big_endian_here = std::endian::native == std::endian::big;
  constexpr std::uint32_t longest_px = 1 << 30;
  return {message.data.data(),
          int(std::min(message.width, longest_px)),
          int(std::min(message.height, longest_px)),
          std::ptrdiff_t(message.step),
          format,
          (message.is_bigendian != 0) != is_big_endian_here};
}

const msg::Header& header_of(const ImageMessage& message) {
  return std::visit([](const auto& image) -> const msg::Header& { return image.header; }, message);
}

Image image_of(const ImageMessage& message, const std::string& source,
               const ImageOptions& options) {
  return std::visit([&](const auto& image) { return image_of(image, source, options); }, message);
}

msg::Image message_of(const RgbImage& image, const msg::Header& header) {
  return {.header = header,
          .height = std::uint32_t(image.height),
          .width = std::uint32_t(image.width),
          .encoding = "rgb8",
          .step = std::uint32_t(3 * image.width),
          .data = image.pixels};
}

msg::Image message_of(const Image& image, const msg::Header& header) {
  return {.header = header,
          .height = std::uint32_t(image.height),
          .width = std::uint32_t(image.width),
          .encoding = "mono8",
          .step = std::uint32_t(image.width),
          .data = image.pixels};
}

}  // namespace edgescout::ros2
