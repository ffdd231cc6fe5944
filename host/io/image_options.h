// How stored values become an image of 8 bit grey.
//
// Public header.
#pragma once

#include <vector>

#include "host/core/options.h"

namespace edgescout {

// The colours of the first two pixels of the first two rows: RGGB has red and green above green and
// blue.
enum class BayerPattern { None, RGGB, BGGR, GRBG, GBRG };

// Which stored values become black and white, where an image is deeper than 8 bit.
enum class GreyScaling {
  Auto,       // of the sensor's depth, or of the image where that would leave little contrast
  Quantiles,  // those below and above which 0.1 % of the pixels lie
  Full,       // those of the stored type: 0 and 65535 of 16 bit, 0 and 1 of real numbers
};

struct ImageOptions {
  BayerPattern bayer = BayerPattern::None;  // grey images are the mosaic of a colour sensor
  GreyScaling scaling = GreyScaling::Auto;
  std::vector<double> black_white;  // two stored values, in place of `scaling`, at every depth
  std::vector<double> raw_size_px;  // width and height of files without a header
  void validate() const;            // InputError naming the field
};

void describe(ImageOptions& options, OptionVisitor& visit);

}  // namespace edgescout
