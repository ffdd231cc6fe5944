// How stored values become depth.
//
// Public header.
#pragma once

#include "host/core/depth_image.h"
#include "host/core/options.h"

namespace edgescout {

struct DepthOptions {
  double unit_m = 0;          // of stored values; 0: what the file or dataset says
  Range range_m{0.05, 20.0};  // values outside count as not measured
  DepthNoise noise;           // of the sensor
  void validate() const;      // InputError naming the field
};

void describe(DepthOptions& options, OptionVisitor& visit);

}  // namespace edgescout
