#include "host/io/depth_png.h"

#include <cmath>
#include <limits>
#include <opencv2/core.hpp>
#include <opencv2/imgcodecs.hpp>

#include "host/io/files.h"
#include "kernels/error.h"

namespace edgescout {

void write_depth_png(const DepthImage& depth, double unit_m, const std::filesystem::path& file) {
  check(depth.z_m.size() == std::size_t{1} * depth.width * depth.height,
        "write_depth_png: pixel count");
  constexpr double MOST = std::numeric_limits<std::uint16_t>::max();
  cv::Mat values(depth.height, depth.width, CV_16U);
  for (int y = 0; y < depth.height; ++y)
    for (int x = 0; x < depth.width; ++x) {
      const double units = std::round(depth.at(x, y) / unit_m);
      values.at<std::uint16_t>(y, x) =
          units >= 1 && units <= MOST ? static_cast<std::uint16_t>(units) : std::uint16_t{0};
    }
  std::vector<std::uint8_t> png;
  cv::imencode(".png", values, png);
  write_file_atomically(file, {reinterpret_cast<const char*>(png.data()), png.size()});
}

}  // namespace edgescout
