// The parts of an image that a scan treats one by one.
#pragma once

#include <vector>

#include "host/detect/coarse_scan.h"

namespace edgescout {

// A rectangle of anchors, which share the projection of a template at its middle.
struct ScanRegion {
  int x0, y0, columns, rows;  // first anchor, coarse px, and numbers of anchors
  Eigen::Vector2d middle;     // coarse px
};

// The regions of a level of the view that cover options.within. InputError: it lies outside the
// image.
std::vector<ScanRegion> cut_into_regions(const ObjectView& view, const ReducedTensors& level,
                                         const ScanOptions& options);

}  // namespace edgescout
