// Images of fewer pixels.
#pragma once

#include "host/core/types.h"

namespace edgescout {

// Means of squares of `factor` x `factor` pixels. Columns and rows at the end that fill none are
// left out.
Image reduced(const Image& image, int factor);

}  // namespace edgescout
