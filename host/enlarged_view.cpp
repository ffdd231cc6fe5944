#include "host/enlarged_view.h"

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>

#include "host/register/measured_depth.h"
#include "kernels/error.h"

namespace edgescout {

namespace {

template <class Pixel>
cv::Mat_<Pixel> as_matrix(int width, int height, const std::vector<Pixel>& pixels) {
  return {height, width, const_cast<Pixel*>(pixels.data())};
}

Image resized(const Image& image, int factor) {
  Image large{factor * image.width, factor * image.height, {}};
  large.pixels.resize(std::size_t(large.width) * large.height);
  cv::Mat into = as_matrix(large.width, large.height, large.pixels);
  cv::resize(as_matrix(image.width, image.height, image.pixels), into, into.size(), 0, 0,
             cv::INTER_CUBIC);
  return large;
}

MeasuredDepth resized(const MeasuredDepth& depth, int factor) {
  const DepthImage& image = depth.image;
  MeasuredDepth large{{factor * image.width, factor * image.height, {}}, depth.noise};
  large.image.z_m.reserve(std::size_t(large.image.width) * large.image.height);
  for (int y = 0; y < large.image.height; ++y)
    for (int x = 0; x < large.image.width; ++x)
      large.image.z_m.push_back(image.at(x / factor, y / factor));
  return large;
}

// Noise becomes edges where the blur is that of the small image divided by `factor`. By its root,
// and with faint edges as they were, noise lies as far below the thresholds as before.
EdgesOptions for_enlarged(EdgesOptions options, int factor) {
  const auto by = float(factor);
  options.gradient.sigma_px *= std::sqrt(by);
  options.faint.sigma_px *= by;
  options.faint.low_threshold /= by;
  options.faint.high_threshold /= by;
  options.faint.min_length_px *= factor;
  options.faint_clearance_px *= by;
  return options;
}

bool is_small(const TemplateSet& set, const Camera& camera, double below_px) {
  const double middle_m = std::sqrt(set.options.distance_min_m * set.options.distance_max_m);
  return size_px(set.model.mesh.diameter_m, middle_m, camera) < below_px;
}

ObjectView enlarged(const ObjectView& view, int factor, Backend& backend,
                    const EdgesOptions& edges) {
  check(view.image && !view.tensor && !view.occluders, "enlarged: not a prepared view");
  ObjectView large;
  large.camera = scaled(view.camera, factor);
  large.camera_from_world = view.camera_from_world;
  large.image = std::make_shared<const Image>(resized(*view.image, factor));
  if (view.depth) large.depth = std::make_shared<const MeasuredDepth>(resized(*view.depth, factor));
  large.edges =
      std::make_shared<EdgeIndex>(find_edges(*large.image, for_enlarged(edges, factor), backend),
                                  large.camera.width, large.camera.height);
  return large;
}

}  // namespace

int enlargement_for(std::span<const TemplateSet> sets, std::span<const ObjectView> views,
                    double below_px) {
  constexpr int factor = 2;
  const auto suits = [&](const ObjectView& view) {
    const double pixels = double(factor) * view.camera.width * factor * view.camera.height;
    return pixels <= MOST_ENLARGED_PIXELS && std::ranges::any_of(sets, [&](const TemplateSet& set) {
             return is_small(set, view.camera, below_px);
           });
  };
  return std::ranges::all_of(views, suits) ? factor : 1;
}

std::vector<ObjectView> enlarged(std::span<const ObjectView> views, int factor, Backend& backend,
                                 const EdgesOptions& edges) {
  std::vector<ObjectView> large(views.begin(), views.end());
  if (factor > 1)
    for (ObjectView& view : large) view = enlarged(view, factor, backend, edges);
  return large;
}

}  // namespace edgescout
