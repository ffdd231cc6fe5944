// Draws the pictures of an active detection as text for an HTML page: SVG, and PNG in base64.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "host/io/image.h"
#include "host/model/edge_model.h"
#include "host/register/object_view.h"

namespace edgescout {

// "data:image/png;base64,..."
std::string inline_png(const std::string& png);

// "#rrggbb", from dark blue at 0 to yellow at 1. Equal steps look equal, also in grey.
std::string heat_colour(double fraction);
// A colour of its own for each of the numbers 0, 1 ..
std::array<std::uint8_t, 3> distinct_colour(int number);

struct DrawnView {
  Se3 camera_from_world;
  std::optional<double> information;  // absent: not computed
  int taken = 0;                      // number of the image taken from there, 1, 2 ..; 0: none
  bool unreachable = false;
  bool chosen = false;  // in this step
};
// Draws the directions of the views from the point that they look at, seen from above
// (direction_above of active/views.h, else +z): the middle is straight up, each ring 30 degrees
// lower. The colour is the information, in `unit`.
std::string hemisphere_svg(std::span<const DrawnView> views, const std::string& unit);

struct DrawnParticle {
  int object = 0;
  Se3 camera_from_object;
  double weight = 0;  // the weights of all particles sum to 1
};
// Draws particles over the image with this id in the page: each as a point with the object's x and
// y axes; heavier particles are more opaque.
std::string particles_svg(const std::string& image_id, const Camera& camera,
                          std::span<const DrawnParticle> particles,
                          std::span<const EdgeModel> models);

// An object of an edge map and the number of its colour (distinct_colour).
struct DrawnObject : ObjectPose {
  int colour = 0;
};
// Draws the edges of all objects as the camera of `view` would see them, each object in its colour.
// Edges that one of the objects hides are left out. At most `width_px` wide. Of `view` only the
// camera and its pose are used.
RgbImage edge_map(std::span<const EdgeModel> models, std::span<const DrawnObject> objects,
                  const ObjectView& view, int width_px, Backend& backend);

}  // namespace edgescout
