#include "host/bridge/ros2/image_message.h"

#include <algorithm>
#include <iterator>
#include <optional>

#include "host/bridge/ros2/frames.h"
#include "kernels/error.h"

namespace edgescout::ros2 {

namespace {

struct Encoding {
  const char* name;
  int channels, channel_bytes;
  bool is_red_first = false;
  bool is_luma_first = true;
  BayerPattern bayer = BayerPattern::None;
};

// sensor_msgs/image_encodings.hpp.
constexpr Encoding encodings[] = {
    {"mono8", 1, 1},
    {"mono16", 1, 2},
    {"bgr8", 3, 1},
    {"rgb8", 3, 1, true},
    {"bgra8", 4, 1},
    {"rgba8", 4, 1, true},
    {"bgr16", 3, 2},
    {"rgb16", 3, 2, true},
    {"bgra16", 4, 2},
    {"rgba16", 4, 2, true},
    {"bayer_rggb8", 1, 1, false, true, BayerPattern::RGGB},
    {"bayer_bggr8", 1, 1, false, true, BayerPattern::BGGR},
    {"bayer_gbrg8", 1, 1, false, true, BayerPattern::GBRG},
    {"bayer_grbg8", 1, 1, false, true, BayerPattern::GRBG},
    {"bayer_rggb16", 1, 2, false, true, BayerPattern::RGGB},
    {"bayer_bggr16", 1, 2, false, true, BayerPattern::BGGR},
    {"bayer_gbrg16", 1, 2, false, true, BayerPattern::GBRG},
    {"bayer_grbg16", 1, 2, false, true, BayerPattern::GRBG},
    {"yuv422", 2, 1, false, false},  // u y v y
    {"uyvy", 2, 1, false, false},
    {"yuv422_yuy2", 2, 1},
    {"yuyv", 2, 1},
    {"8UC1", 1, 1},  // OpenCV's: colours are in its own order
    {"8UC3", 3, 1},
    {"8UC4", 4, 1},
    {"16UC1", 1, 2},
    {"16UC3", 3, 2},
    {"16UC4", 4, 2},
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

Image image_of(const msg::Image& message, const std::string& source, const ImageOptions& options) {
  const std::optional<Encoding> encoding = encoding_named(message.encoding);
  if (!encoding)
    throw InputError(source, "encoding", shown(message.encoding),
                     "mono8, mono16, bgr8, rgb8, bgra8, rgba8, their 16-bit forms, bayer_..8 or "
                     "..16, yuv422, yuv422_yuy2, 8UC1 to 8UC4 or 16UC1 to 16UC4");
  constexpr std::uint32_t longest_px = 1 << 30;
  const PixelLayout layout{.width = int(std::min(message.width, longest_px)),
                           .height = int(std::min(message.height, longest_px)),
                           .row_bytes = message.step,
                           .channels = encoding->channels,
                           .channel_bytes = encoding->channel_bytes,
                           .is_luma_first = encoding->is_luma_first,
                           .is_red_first = encoding->is_red_first,
                           .is_big_endian = message.is_bigendian != 0};
  return grey_image(message.data, layout, source, with_pattern(options, encoding->bayer));
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
