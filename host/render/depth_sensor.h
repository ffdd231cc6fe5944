// The depth sensor of rendered scenes and its errors.
#pragma once

#include "host/core/options.h"

namespace edgescout {

// The sensor is registered to the grey camera: both see the same pixels. 0 switches an error off.
// host/render/measure_depth.h says in which order errors act.
struct DepthSensor {
  bool on = false;
  double unit_m = 1e-4;         // of the values in the files
  Range range_m{0.1, 6};        // beyond it nothing is measured
  double noise_m = 0.001;       // standard deviation at 1 m; grows with the distance squared
  double noise_floor_m = 5e-4;  // the least that it states of its noise (SimulatedCell)
  double noise_blur_px = 0;     // neighbouring pixels have like errors; 0: each has its own
  double step_m = 0.0005;  // at 1 m: equal steps of disparity, which grow with the distance squared
  // Cosine of the angle between normal and line of sight. At the least one nothing is measured; the
  // probability of a measurement grows over the ramp to 1.
  double grazing_cosine = 0.1, grazing_ramp = 0.2;
  double saturation_grey = 250;  // where the image is as bright nothing is measured
  double highlight = 0.5;        // where a lamp's highlight adds as much light; 1 is white
  // From the camera to the projector along x. What the projector does not see is not measured.
  double baseline_m = 0.075;
  // Around jumps of depth, this far: a share is missing, the rest lies between both surfaces.
  double border_px = 1, border_missing = 0.5;
  double holes = 0;    // share of the parts' pixels that is missing in blobs, beside all of this
  double hole_px = 5;  // standard deviation of the blur that makes the blobs
  double bias_m = 0;   // added to all depths
  double rotation_deg = 0;  // error of the calibration to the grey camera; the axis is random
};
void describe(DepthSensor& sensor, OptionVisitor& visit);
// Its errors but for the noise of each pixel.
void describe_errors(DepthSensor& sensor, OptionVisitor& visit);

}  // namespace edgescout
