// Registers a pose on the tensor of the object's surroundings alone: a fraction of the work that
// the whole image takes.
#pragma once

#include <optional>
#include <span>

#include "host/core/types.h"
#include "host/register/refine.h"
#include "host/track/normal_search.h"
#include "host/track/track_options.h"
#include "kernels/backend.h"

namespace edgescout {

// The part of an image that shows an object in a pose with a margin, and its camera: poses keep
// their frame. Empty where the object is not in the image.
struct Crop {
  Image image;
  Camera camera;
  // px of the image per px of the crop. The crop has at most 400 x 400 pixels: more would make its
  // registration slow.
  int reduction = 1;
};
std::optional<Crop> crop_around(const SearchedImage& image, const EdgeModel& model,
                                const Se3& camera_from_object);

struct CroppedDetection : Detection {
  int reduction = 1;  // of the crop
};
// The most probable of the poses registered from the starts (all in the camera frame) in the
// surroundings of the first one. Empty where the object is not in the image, or the limit was over
// before they were registered.
std::optional<CroppedDetection> register_in_crop(const SearchedImage& image, const EdgeModel& model,
                                                 std::span<const Se3> starts, Backend& backend,
                                                 const TrackOptions& options,
                                                 const TimeLimit& limit = {});

}  // namespace edgescout
