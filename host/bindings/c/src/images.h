// Images of the caller.
#pragma once

#include "host/bindings/c/edgescout.h"
#include "host/core/types.h"

namespace edgescout::c {

// The grey image of the caller's pixels. EDGESCOUT_BAD_INPUT: a format that does not exist, what
// grey_image (io/pixels.h) refuses.
Image image_of(const edgescout_image* image);

}  // namespace edgescout::c
