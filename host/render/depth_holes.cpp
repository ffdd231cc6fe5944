#include "host/render/depth_holes.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "host/render/projector_shadow.h"
#include "host/render/smooth_noise.h"
#include "kernels/thread_pool.h"

namespace edgescout {
namespace {

cv::Mat noise_of(const SensedView& sensed, const char* error, double blur_px) {
  return smooth_noise({sensed.grey.width, sensed.grey.height}, blur_px, sensed.stream(error));
}

// Holes of like cosines come in patches, not in single pixels.
void drop_grazing(DepthImage& depth, const SensedView& sensed) {
  constexpr double PATCH_PX = 1.5;
  const DepthSensor& sensor = sensed.sensor();
  const cv::Mat noise = noise_of(sensed, "depth grazing", PATCH_PX);
  for (std::size_t i = 0; i < depth.z_m.size(); ++i) {
    const SeenSurface& seen = sensed.surfaces[i];
    if (seen.triangle == HORIZON) continue;
    const double above = seen.normal.dot(seen.to_viewer) - sensor.grazing_cosine;
    const double even =
        0.5 * std::erfc(-noise.at<float>(static_cast<int>(i)) / std::numbers::sqrt2);
    if (above <= even * sensor.grazing_ramp) depth.z_m[i] = DEPTH_MISSING;
  }
}

void drop_saturated(DepthImage& depth, const SensedView& sensed) {
  if (sensed.sensor().saturation_grey <= 0) return;
  for (std::size_t i = 0; i < depth.z_m.size(); ++i)
    if (sensed.grey.pixels[i] >= sensed.sensor().saturation_grey) depth.z_m[i] = DEPTH_MISSING;
}

void drop_highlights(DepthImage& depth, const SensedView& sensed, ThreadPool& pool) {
  if (sensed.sensor().highlight <= 0) return;
  for_each_in_chunks(pool, depth.z_m.size(), 1024, [&](std::size_t i) {
    if (!sensed.is_part(i) || depth.z_m[i] == DEPTH_MISSING) return;
    const SeenSurface& seen = sensed.surfaces[i];
    const ReceivedLight light =
        sensed.shading.lighting.at(shaded_point(sensed.view, seen), material_of(sensed.view, seen));
    if (light.specular >= sensed.sensor().highlight) depth.z_m[i] = DEPTH_MISSING;
  });
}

void drop_shadow(DepthImage& depth, const SensedView& sensed, ThreadPool& pool) {
  if (sensed.sensor().baseline_m == 0) return;
  const std::vector<char> lit = lit_by_projector(sensed.view, sensed.scene_view, sensed.surfaces,
                                                 sensed.sensor().baseline_m, pool);
  for (std::size_t i = 0; i < lit.size(); ++i)
    if (!lit[i]) depth.z_m[i] = DEPTH_MISSING;
}

// The share is exact in every image: it is that of the parts' pixels with the smallest noise.
void drop_blobs(DepthImage& depth, const SensedView& sensed) {
  if (sensed.sensor().holes <= 0) return;
  const cv::Mat noise = noise_of(sensed, "depth holes", sensed.sensor().hole_px);
  std::vector<std::pair<float, std::size_t>> parts;
  for (std::size_t i = 0; i < depth.z_m.size(); ++i)
    if (sensed.is_part(i)) parts.emplace_back(noise.at<float>(static_cast<int>(i)), i);
  const auto count = static_cast<std::ptrdiff_t>(
      std::llround(sensed.sensor().holes * static_cast<double>(parts.size())));
  std::nth_element(parts.begin(), parts.begin() + count, parts.end());
  for (std::ptrdiff_t k = 0; k < count; ++k) depth.z_m[parts[k].second] = DEPTH_MISSING;
}

void drop_out_of_range(DepthImage& depth, const Range& range_m) {
  for (float& z_m : depth.z_m)
    if (!(z_m >= range_m.low && z_m <= range_m.high)) z_m = DEPTH_MISSING;
}

}  // namespace

void drop_unmeasured(DepthImage& depth, const SensedView& sensed, ThreadPool& pool) {
  drop_grazing(depth, sensed);
  drop_saturated(depth, sensed);
  drop_highlights(depth, sensed, pool);
  drop_shadow(depth, sensed, pool);
  drop_blobs(depth, sensed);
  drop_out_of_range(depth, sensed.sensor().range_m);
}

}  // namespace edgescout
