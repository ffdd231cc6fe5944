// Images of the caller.
#pragma once

#include "host/bindings/c/edgescout.h"
#include "host/core/types.h"
#include "host/register/measured_depth.h"

namespace edgescout::c {

// The grey image of the caller's pixels. EDGESCOUT_BAD_INPUT: a format that does not exist, what
// grey_image (io/pixels.h) refuses.
Image image_of(const edgescout_image* image);

// The same of distances, and of the sensor that their options describe. EDGESCOUT_BAD_INPUT: a
// format that does not exist, what depth_image (io/depth_file.h) refuses.
MeasuredDepth depth_of(const edgescout_image* depth);

}  // namespace edgescout::c
