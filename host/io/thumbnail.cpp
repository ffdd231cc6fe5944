#include "host/io/thumbnail.h"

#include <algorithm>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>
#include <vector>

#include "host/io/byte_numbers.h"
#include "host/io/files.h"
#include "host/io/png_chunks.h"
#include "kernels/error.h"

namespace edgescout {

namespace {

constexpr const char* thumbnail_chunk = "thMB";  // private, and of no use beside other pixels
constexpr std::size_t header_end = 33;           // of PNG's first bytes and its chunk IHDR
constexpr std::size_t most_bytes = 1 << 20;

std::string jpeg_of(const cv::Mat& bgr) {
  const double scale = std::min(1.0, double(THUMBNAIL_SIDE_PX) / std::max(bgr.cols, bgr.rows));
  const cv::Size size(std::max(1, cvRound(scale * bgr.cols)),
                      std::max(1, cvRound(scale * bgr.rows)));
  cv::Mat small;
  cv::resize(bgr, small, size, 0, 0, cv::INTER_AREA);
  std::vector<std::uint8_t> bytes;
  cv::imencode(".jpg", small, bytes, {cv::IMWRITE_JPEG_QUALITY, 75, cv::IMWRITE_JPEG_OPTIMIZE, 1});
  return {bytes.begin(), bytes.end()};
}

// Nothing: the chunk after the header is another.
std::optional<std::string> carried(std::istream& png) {
  std::string head(header_end + 8, '\0');
  png.read(head.data(), std::streamsize(head.size()));
  const std::size_t length = ByteNumbers{head}.at(header_end, 4);
  if (!png || head.substr(header_end + 4) != thumbnail_chunk || length > most_bytes) return {};
  std::string jpeg(length, '\0');
  png.read(jpeg.data(), std::streamsize(length));
  return png ? std::optional(std::move(jpeg)) : std::nullopt;
}

std::string made_from(const std::filesystem::path& file) {
  const std::string bytes = needed_png_chunks(read_file(file), file.string());
  const cv::Mat bgr = cv::imdecode(
      cv::Mat(1, static_cast<int>(bytes.size()), CV_8U, const_cast<char*>(bytes.data())),
      cv::IMREAD_COLOR);
  if (bgr.empty()) throw InputError(file.string(), "image", "no pixels", "a whole PNG file");
  return jpeg_of(bgr);
}

}  // namespace

void save_png_with_thumbnail(const RgbImage& image, const std::filesystem::path& file) {
  const std::string png = encode_png(image);
  const cv::Mat rgb(image.height, image.width, CV_8UC3,
                    const_cast<std::uint8_t*>(image.pixels.data()));
  cv::Mat bgr;
  cv::cvtColor(rgb, bgr, cv::COLOR_RGB2BGR);
  const std::string_view all(png);
  write_parts_atomically(
      file,
      {all.substr(0, header_end), png_chunk(thumbnail_chunk, jpeg_of(bgr)), all.substr(header_end)},
      Flush::Yes);
}

std::optional<std::string> thumbnail_in(const std::filesystem::path& file) {
  try {
    std::ifstream png = open_file(file);
    if (auto jpeg = carried(png)) return jpeg;
    return made_from(file);
  } catch (const InputError&) {
    return {};
  }
}

}  // namespace edgescout
