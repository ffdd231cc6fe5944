// Makes the grey image that a camera gives from the light that its lens receives.
#pragma once

#include <opencv2/core.hpp>

#include "host/core/random.h"
#include "host/render/scene.h"

namespace edgescout {

// The light is CV_32F; 1 is white. `view` is the number of the image in its scene: its effects are
// drawn from the options' seed and this number.
Image develop(cv::Mat light, const RenderOptions& options, const Camera& camera, std::size_t view);

// The shift of the image's corner that develop() draws for this image (optics.h).
double lens_residue_px(const RenderOptions& options, std::size_t view);

}  // namespace edgescout
