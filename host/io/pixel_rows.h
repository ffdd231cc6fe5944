// Copies pixels of the caller into a matrix.
#pragma once

#include <opencv2/core.hpp>
#include <string>

#include "host/io/pixels.h"

namespace edgescout {

// Without padding, values as this machine orders their bytes; MonoUint32 becomes CV_32S. InputError
// naming `source`: no pixels, more than 2^28 of them, a stride that is shorter than a row.
cv::Mat pixel_rows(const Pixels& pixels, const std::string& source);

}  // namespace edgescout
