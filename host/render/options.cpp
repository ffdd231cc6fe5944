#include <cmath>
#include <string>

#include "host/render/scene.h"
#include "kernels/error.h"

namespace edgescout {
namespace {

template <typename Number>
void require(Number value, Number low, Number high, const char* field) {
  if (value >= low && value <= high) return;  // false for NaN
  throw InputError("render options", field, std::to_string(value),
                   "a value in [" + std::to_string(low) + ", " + std::to_string(high) + "]");
}

}  // namespace

void RenderOptions::validate() const {
  require(width, 16, 8192, "width");
  require(height, 16, 8192, "height");
  require(focal_px, 1.0, 1e5, "focal_px");
  require(objects, 1, 20, "objects");
  require(views, 1, 50, "views");
  require(clutter, 0, 2, "clutter");
  require(pile, 0.0, 1.0, "pile");
  require(min_elevation_deg, 10.0, 90.0, "min_elevation_deg");
  require(max_elevation_deg, min_elevation_deg, 90.0, "max_elevation_deg");
  require(min_distance_m, 0.0, 100.0, "min_distance_m");
  require(max_distance_m, min_distance_m, 100.0, "max_distance_m");
  if (max_distance_m > 0 && min_distance_m <= 0)
    throw InputError("render options", "min_distance_m", std::to_string(min_distance_m),
                     "above 0 with max_distance_m");
  require(blur_px, 0.0, 10.0, "blur_px");
  require(noise_grey, 0.0, 50.0, "noise_grey");
  require(supersampling, 1, 7, "supersampling");
  if (supersampling % 2 == 0)
    throw InputError("render options", "supersampling", std::to_string(supersampling),
                     "an odd number");
  check_bounds(clutter_ranges, "render.clutter");
  if (const Range& span_px = clutter_ranges.span_px; span_px.high > 0)
    require(span_px.low, 5.0, span_px.high, "clutter.span_px");
  check_bounds(surfaces, "render.surfaces");
  check_bounds(light, "render.light");
  check_bounds(camera, "render.camera");
  check_bounds(depth, "render.depth");
}

}  // namespace edgescout
