// Internal to host/io: what cameras write beside the pixels.
#pragma once

#include <string_view>

namespace edgescout {

// The orientation tag of a JPEG, PNG, WebP or TIFF file: 1 as stored, 2 to 8 turned or mirrored. 1
// where it has none.
int exif_orientation(std::string_view bytes);

}  // namespace edgescout
