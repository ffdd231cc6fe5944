#include "host/render/depth_sensor.h"

namespace edgescout {
namespace {

void describe_offsets(DepthSensor& o, OptionVisitor& visit) {
  visit.number({"depth-noise-blur",
                "Standard deviation of the blur of that noise, px. 0: each pixel has its own"},
               o.noise_blur_px, 0.0, 50.0);
  visit.number({"depth-step",
                "Step between two depths at 1 m, m. Grows with the distance squared, as steps of "
                "disparity do. 0: none"},
               o.step_m, 0.0, 0.1);
  visit.number({"depth-bias", "Added to all depths, m"}, o.bias_m, -0.1, 0.1);
  visit.number({"depth-rotation",
                "Error of the rotation between depth sensor and grey camera, degrees. The axis is "
                "random, the same in a scene"},
               o.rotation_deg, 0.0, 10.0);
}

void describe_holes(DepthSensor& o, OptionVisitor& visit) {
  visit.number({"depth-grazing",
                "Cosine of normal and line of sight at and below which nothing is measured"},
               o.grazing_cosine, 0.0, 1.0);
  visit.number(
      {"depth-grazing-ramp", "Range of the cosine above it in which some pixels are missing"},
      o.grazing_ramp, 0.0, 1.0);
  visit.number({"depth-saturation", "Grey level from which nothing is measured. 0: not used"},
               o.saturation_grey, 0.0, 255.0);
  visit.number({"depth-highlight",
                "Light of a lamp's highlight from which nothing is measured. 1 is white; 0: not "
                "used"},
               o.highlight, 0.0, 100.0);
  visit.number({"depth-baseline",
                "From the camera to the projector along x, m. What the projector does not see is "
                "missing. 0: no shadow"},
               o.baseline_m, -1.0, 1.0);
  visit.number({"depth-border", "Pixels around a jump of depth that are missing or smeared"},
               o.border_px, 0.0, 10.0);
  visit.number({"depth-border-missing",
                "Share of them that is missing. The rest lies between both surfaces"},
               o.border_missing, 0.0, 1.0);
  visit.number({"depth-holes",
                "Share of the parts' pixels that is missing in blobs, beside all other holes"},
               o.holes, 0.0, 1.0);
  visit.number({"depth-hole-size", "Standard deviation of the blur that makes the blobs, px"},
               o.hole_px, 0.5, 200.0);
}

}  // namespace

void describe(DepthSensor& o, OptionVisitor& visit) {
  visit.group("Depth");
  visit.flag({"depth", "Write depth images with a sensor's errors, registered to the grey ones",
              OptionLevel::Basic},
             o.on);
  visit.number({"depth-unit", "Length of one stored unit of depth, m"}, o.unit_m, 1e-6, 0.1);
  visit.range({"depth-range", "Depths that the sensor measures, m"}, o.range_m, 0.0, 100.0);
  visit.number(
      {"depth-noise", "Standard deviation of depth at 1 m, m. Grows with the distance squared"},
      o.noise_m, 0.0, 0.1);
  describe_errors(o, visit);
}

void describe_errors(DepthSensor& o, OptionVisitor& visit) {
  visit.group("Depth sensor");
  describe_offsets(o, visit);
  describe_holes(o, visit);
}

}  // namespace edgescout
