#include "host/io/image_options.h"

namespace edgescout {

void describe(ImageOptions& o, OptionVisitor& visit) {
  static constexpr const char* patterns[] = {"none", "rggb", "bggr", "grbg", "gbrg"};
  static constexpr const char* scalings[] = {"auto", "quantiles", "full"};
  constexpr double any = 1e9, longest_side_px = 65535;
  visit.group("Images");
  visit.choice({"bayer",
                "Grey images are the mosaic of a colour sensor. The colours of its first two rows: "
                "rggb, bggr, grbg or gbrg"},
               o.bayer, patterns);
  visit.choice({"image-scaling",
                "Which values become black and white in images deeper than 8 bit. auto: those of "
                "the sensor's depth, or of the image where it has little contrast; quantiles: 0.1 "
                "and 99.9 %; full: those of the stored type"},
               o.scaling, scalings);
  visit.numbers(
      {"image-range", "Stored values that become black and white, in place of --image-scaling"},
      o.black_white, 2, -any, any);
  visit.numbers({"raw-size", "Width and height, px, of image files without a header"},
                o.raw_size_px, 2, 1, longest_side_px);
}

void ImageOptions::validate() const {
  check_bounds(*this, "images");
  if (!black_white.empty() && !(black_white[0] < black_white[1]))
    BoundsCheck("images").fail("image_range", "black not below white", "black below white");
}

}  // namespace edgescout
