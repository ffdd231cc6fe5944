// Images of numpy arrays, read as the C interface reads pixels (io/pixels.h).
#pragma once

#include "host/bindings/python/src/arrays.h"
#include "host/core/depth_image.h"
#include "host/io/depth_options.h"
#include "host/io/image.h"

namespace edgescout::python {

// What load_image makes of a file of these pixels. uint8 or uint16 of (height, width) or
// (height, width, 1, 3 or 4), colours in the order red, green, blue; or float32 of (height, width).
// Deeper values are scaled to 8 bit by the options. Any strides, either order of bytes; rows are
// not copied by numpy where their pixels follow one another, also from blue to red
// (image[:, :, ::-1]). ValueError: another type or shape; InputError: grey_image refuses the
// pixels. Gives up the interpreter's lock.
Image image_of(const py::handle& value, const ImageOptions& options = {});

// A depth image of uint16, uint32 or float32 of (height, width). Any strides, either order of
// bytes. ValueError: another type or shape; InputError: depth_image (io/depth_file.h) refuses the
// values. Gives up the interpreter's lock.
DepthImage depth_of(const py::handle& value, const DepthOptions& options);

}  // namespace edgescout::python
