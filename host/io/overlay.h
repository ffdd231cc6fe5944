// Pictures of what was found: model edges and axes drawn over the image.
#pragma once

#include <optional>
#include <span>
#include <string>

#include "host/core/types.h"
#include "host/edge/edge_index.h"
#include "host/io/image.h"
#include "host/model/edge_model.h"

namespace edgescout {

class Backend;

struct OverlayPose {
  int object = 0;  // index into the models
  Se3 camera_from_object;
  std::optional<double> score;  // written beside the object's centre, where there is one
  std::string label;            // written before it
};

// The image in grey, with half its contrast, and over it for every pose: the visible edges of its
// model, green where an edge of the image of similar direction (0.35 rad) lies within 3 px, orange
// where none does, and cyan where `edges` is null and nobody knows; the object's axes from the
// centre of its box (x red, y green, z blue), a quarter of its diameter long; label and score.
// `camera` must be ideal and of the image's size. Poses that have the object's centre behind the
// camera are left out.
RgbImage draw_overlay(const Image& image, const Camera& camera, std::span<const OverlayPose> poses,
                      std::span<const EdgeModel> models, const EdgeIndex* edges, Backend& backend);

}  // namespace edgescout
