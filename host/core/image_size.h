// Whether images are those of a camera.
#pragma once

#include <string>

#include "host/core/camera.h"
#include "host/core/depth_image.h"
#include "host/core/types.h"

namespace edgescout {

// InputError naming `source` and `name`: an image of another size than the camera's, or with
// another number of pixels than its size says.
void require_size_of(const Camera& camera, const Image& image, const std::string& source,
                     const std::string& name = "image");
void require_size_of(const Camera& camera, const DepthImage& depth, const std::string& source,
                     const std::string& name = "depth image");

}  // namespace edgescout
