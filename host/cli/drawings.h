// Pictures of an active detection as text that stands in an HTML page by itself: SVG, and PNG in
// base64.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "host/io/image.h"
#include "host/model/edge_model.h"
#include "host/register/d2co.h"

namespace edgescout {

class Backend;

// "data:image/png;base64,..."
std::string inline_png(const std::string& png);

// "#rrggbb"; 0 dark blue, 1 yellow, of even steps to the eye and readable in grey.
std::string heat_colour(double fraction);
// Colours that can be told apart, for things numbered 0, 1 ..
std::array<std::uint8_t, 3> distinct_colour(int number);

struct DrawnView {
  Se3 camera_from_world;
  std::optional<double> information;  // absent: not judged
  int taken = 0;                      // 1, 2 ..: the image taken from there; 0: none
  bool unreachable = false;
  bool chosen = false;  // now
};
// The views' directions from what they look at, seen from above (direction_above, active/views.h;
// +z where there is none): the middle is straight up, each ring 30 degrees lower. Coloured by
// information, which is in `unit`.
std::string hemisphere_svg(std::span<const DrawnView> views, const std::string& unit);

struct DrawnParticle {
  int object = 0;
  Se3 camera_from_object;
  double weight = 0;  // of all particles: sums to 1
};
// Over the image with this id in the page: each particle a place and the object's x and y axes,
// darker the heavier.
std::string particles_svg(const std::string& image_id, const Camera& camera,
                          std::span<const DrawnParticle> particles,
                          std::span<const EdgeModel> models);

// The edges a scene made of these objects would show, hidden ones removed, each object in its
// colour; at most `width_px` wide.
RgbImage edge_map(std::span<const EdgeModel> models, std::span<const ObjectPose> members,
                  std::span<const int> colours, const Camera& camera, const Se3& camera_from_world,
                  int width_px, Backend& backend);

}  // namespace edgescout
