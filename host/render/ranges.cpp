#include "host/render/ranges.h"

namespace edgescout {

void describe(ClutterRanges& o, OptionVisitor& visit) {
  visit.group("Clutter and size");
  visit.range({"span-px",
               "Pixels that the parts' mean diameter spans: sets the distance, in place of "
               "--min-distance and --max-distance. 0: not used"},
              o.span_px, 0, 5000);
  visit.range({"clutter-objects", "Number of parts from the files of --clutter-model in a scene"},
              o.file_parts, 0, 40);
  visit.range({"clutter-size", "Their diameter over the parts' mean diameter"}, o.size, 0.05, 10);
  visit.range({"occluders", "Number of foreign parts that hang between cameras and parts"},
              o.occluders, 0, 20);
  visit.number({"background-share", "Share of the scenes that have a photograph of --backgrounds"},
               o.background_share, 0.0, 1.0);
  visit.number(
      {"board-texture-share", "Share of the scenes that have a photograph of --board-texture"},
      o.board_texture_share, 0.0, 1.0);
}

void describe(SurfaceRanges& o, OptionVisitor& visit) {
  visit.group("Surfaces");
  visit.number({"metal", "Share of the models that are bare metal and reflect their surroundings"},
               o.metal, 0.0, 1.0);
  visit.range({"reflectance", "Reflectance of metal"}, o.reflectance, 0.02, 1);
  visit.range({"roughness", "Roughness of what reflects. 0.02: a mirror; 1: matt"}, o.roughness,
              0.02, 1);
  visit.range({"anisotropy", "Direction of the roughness of metal. 0: none; 0.9: brushed"},
              o.anisotropy, 0, 0.95);
  visit.range({"gloss", "Reflectance of parts that are not metal. 0.04: plastic"}, o.gloss, 0, 1);
  visit.range({"board-gloss", "Reflectance of the board"}, o.board_gloss, 0, 1);
  visit.range({"albedo", "Diffuse reflectance of parts that are not metal. 0: a mixture"}, o.albedo,
              0, 1);
}

void describe(LightRanges& o, OptionVisitor& visit) {
  visit.group("Light");
  visit.range(
      {"lamp-width", "Radius of a lamp over its distance: how soft shadows are. 0: a mixture"},
      o.lamp_width, 0, 1);
  visit.range({"lamp-share", "Share of the light that comes from the lamps. 0: a mixture"},
              o.lamp_share, 0, 1);
}

void describe(CameraRanges& o, OptionVisitor& visit) {
  visit.group("Lens and camera");
  visit.range({"brightness", "Factor on the light of an image"}, o.brightness, 0.005, 20);
  visit.range({"contrast", "Factor on grey about the mean of an image. 0.02: nearly no contrast"},
              o.contrast, 0, 3);
  visit.range({"gamma", "Exponent of the display curve"}, o.gamma, 0.5, 4);
  visit.range({"lens-residue",
               "Radial distortion that the camera's file does not tell: shift of the corner, px"},
              o.lens_residue_px, -5, 5);
  visit.range({"defocus", "Radius of the disc of defocus, px"}, o.defocus_px, 0, 20);
  visit.range({"motion-blur", "Length of the motion blur, px"}, o.motion_px, 0, 50);
  visit.range({"vignetting", "Share of the light that the corner of an image loses"}, o.vignetting,
              0, 0.95);
  visit.range(
      {"sensor-noise", "Standard deviation of the noise at grey 128, half of it shot noise"},
      o.noise_grey, 0, 60);
  visit.range({"sharpening", "Amount of the camera's sharpening"}, o.sharpening, 0, 5);
  visit.range({"sharpening-radius", "Standard deviation of the unsharp mask, px"},
              o.sharpening_radius_px, 0.3, 5);
  visit.range({"jpeg", "Quality of JPEG compression. 0: none"}, o.jpeg_quality, 0, 100);
}

}  // namespace edgescout
