#include "host/render/photographs.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <opencv2/imgproc.hpp>
#include <set>

#include "host/io/image.h"
#include "kernels/error.h"

namespace edgescout {
namespace {

// The largest window of the wanted shape, times a factor that leaves at least half as many pixels
// as are wanted.
cv::Size crop_size(const Image& photograph, int width, int height, Random& random) {
  const double largest = std::min(static_cast<double>(photograph.width) / width,
                                  static_cast<double>(photograph.height) / height);
  const double scale = largest * random.uniform(std::min(1.0, std::max(0.35, 0.5 / largest)), 1.0);
  return {std::clamp(static_cast<int>(std::lround(scale * width)), 1, photograph.width),
          std::clamp(static_cast<int>(std::lround(scale * height)), 1, photograph.height)};
}

}  // namespace

PhotographFolders list_photographs(const std::filesystem::path& folder) {
  std::error_code failed;
  std::map<std::filesystem::path, std::set<std::filesystem::path>> by_folder;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(
           folder, std::filesystem::directory_options::skip_permission_denied, failed))
    if (entry.is_regular_file() && has_image_extension(entry.path()))
      by_folder[entry.path().parent_path()].insert(entry.path());
  if (failed) throw InputError(folder.string(), "photographs", failed.message(), "a folder");
  if (by_folder.empty())
    throw InputError(folder.string(), "photographs", "no image", "at least one image file");
  PhotographFolders photographs;
  for (const auto& [parent, files] : by_folder)
    photographs.emplace_back(files.begin(), files.end());
  return photographs;
}

Image random_crop(const PhotographFolders& photographs, int width, int height, Random random) {
  const auto& folder = photographs[random.below(static_cast<int>(photographs.size()))];
  Image photograph = load_image(folder[random.below(static_cast<int>(folder.size()))]);
  const cv::Size size = crop_size(photograph, width, height, random);
  const cv::Rect window({random.below(photograph.width - size.width + 1),
                         random.below(photograph.height - size.height + 1)},
                        size);
  cv::Mat crop =
      cv::Mat(photograph.height, photograph.width, CV_8U, photograph.pixels.data())(window);
  if (random.below(2) == 0) cv::flip(crop, crop, 1);
  cv::Mat scaled;
  cv::resize(crop, scaled, {width, height}, 0, 0,
             size.width > width ? cv::INTER_AREA : cv::INTER_CUBIC);
  return {width, height, {scaled.datastart, scaled.dataend}};
}

Image mirrored_tiles(const Image& image, int side_px) {
  const auto mirrored = [](int at, int size) {
    const int in_pair = at % (2 * size);
    return in_pair < size ? in_pair : 2 * size - 1 - in_pair;
  };
  Image tiles{side_px, side_px, {}};
  tiles.pixels.reserve(static_cast<std::size_t>(side_px) * side_px);
  for (int y = 0; y < side_px; ++y)
    for (int x = 0; x < side_px; ++x)
      tiles.pixels.push_back(image.at(mirrored(x, image.width), mirrored(y, image.height)));
  return tiles;
}

double light_of_grey(double grey) { return std::pow(grey / 255, 2.2); }

}  // namespace edgescout
