// Direct: "a simple coarse-to-fine object registration strategy that uses a Gaussian pyramid of
// gradient magnitudes images" (paper, Sec. 6). There is no edge detection. It minimises the squares
// of r = 1 - |grad I| / (the level's largest) at all projected points, level by level.
#include <algorithm>
#include <cmath>
#include <memory>

#include <opencv2/imgproc.hpp>

#include "host/baselines/methods.h"
#include "host/baselines/point_sums.h"
#include "host/baselines/scalar_image.h"
#include "kernels/error.h"

namespace edgescout {

namespace {

cv::Mat gradient_magnitude(const Image& image) {
  const cv::Mat grey(image.height, image.width, CV_8UC1,
                     const_cast<std::uint8_t*>(image.pixels.data()));
  cv::Mat gx, gy, magnitude;
  cv::Sobel(grey, gx, CV_32F, 1, 0);
  cv::Sobel(grey, gy, CV_32F, 0, 1);
  cv::magnitude(gx, gy, magnitude);
  return magnitude;
}

// Divided by the level's largest; zero where the image is flat.
ScalarImage normalised(const cv::Mat& magnitude) {
  double largest = 0;
  cv::minMaxLoc(magnitude, nullptr, &largest);
  const cv::Mat scaled = largest > 0 ? cv::Mat(magnitude / largest) : magnitude;
  return {scaled.cols, scaled.rows, {scaled.begin<float>(), scaled.end<float>()}};
}

// Finest first; levels smaller than 16 px are left out.
MagnitudePyramid magnitude_pyramid(const Image& image, int levels) {
  cv::Mat level = gradient_magnitude(image);
  MagnitudePyramid pyramid{normalised(level)};
  while (int(pyramid.size()) < levels && std::min(level.cols, level.rows) >= 32) {
    cv::Mat half;
    cv::pyrDown(level, half);
    level = half;
    pyramid.push_back(normalised(level));
  }
  return pyramid;
}

}  // namespace

WorldSystem magnitude_system(std::span<const ObjectView> views,
                             std::span<const std::vector<ModelPoint>> points,
                             std::span<const MagnitudePyramid> pyramids, int level,
                             const Se3& world_from_object) {
  return sum_over_points(views, points, world_from_object,
                         [&](WorldSystem& sum, std::size_t v, std::size_t,
                             const PosedPoint<double>& posed, const ProjectedEdge<double>& at) {
                           const int own = std::min(level, int(pyramids[v].size()) - 1);
                           // Pixel i of a halved image lies on pixel 2 i of the larger one.
                           const double shrink = std::ldexp(1.0, -own);
                           const Sample m = sample(pyramids[v][own], shrink * at.u, shrink * at.v);
                           const double r = 1 - m.value;
                           add_residual(sum, r, 1, 0.5 * r * r,
                                        image_motion(-shrink * m.by_x, -shrink * m.by_y, posed,
                                                     views[v].tensor->intrinsics));
                           sum.residual_sum += r;
                           sum.weight_sum += 1;
                           sum.points += 1;
                         });
}

PoseSolver prepare_direct(std::span<const ObjectView> views, const BaselineOptions& options) {
  const auto pyramids = std::make_shared<std::vector<MagnitudePyramid>>();
  int levels = 1;
  for (const ObjectView& view : views) {
    check(view.image != nullptr, "direct: a view without its image");
    pyramids->push_back(magnitude_pyramid(*view.image, options.pyramid_levels));
    levels = std::max(levels, int(pyramids->back().size()));
  }
  return [views, options, pyramids, levels](const Se3& start,
                                            std::span<const std::vector<ModelPoint>> points) {
    LmState state;
    state.pose = start;
    for (int level = levels - 1; level >= 0; --level)
      levenberg_marquardt(
          state,
          [&](const Se3& pose) { return magnitude_system(views, points, *pyramids, level, pose); },
          options.inner_iterations, options.min_step_m, options.min_step_rad);
    return state;
  };
}

}  // namespace edgescout
