// Draws the edges and axes of models in given poses over an image.
//
// Public header.
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
  std::optional<double> score;  // written near the object's centre, hundredths cut off
  std::string label;            // written before the score
  bool compare = true;          // false: the edges are cyan, whether the image has them or not
  bool axes = true;             // false: neither axes nor label and score
};

// Returns the image in grey at half its contrast. Over it, for every pose:
//   - the visible edges of the model: green if an image edge of similar direction (0.35 rad) lies
//     within 3 px, orange if not; cyan if `edges` is null or the pose is not compared;
//   - the object's axes from the centre of its box, a quarter of the diameter long: x red, y green,
//     z blue;
//   - label and score.
// `camera` must be ideal and of the image's size (LogicError). A pose with the object's centre
// behind the camera is left out.
RgbImage draw_overlay(const Image& image, const Camera& camera, std::span<const OverlayPose> poses,
                      std::span<const EdgeModel> models, const EdgeIndex* edges, Backend& backend);

}  // namespace edgescout
