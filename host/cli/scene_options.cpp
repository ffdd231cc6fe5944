#include "host/cli/scene_options.h"

namespace edgescout {

void add_scene_options(CLI::App& verb, RenderOptions& o, OptionLevel level) {
  OptionTable(verb, "Scene", level)
      .bounded("seed", o.seed, 0u, 4000000000u, "Seed of the first scene. Scene i has seed + i")
      .bounded("objects", o.objects, 1, 20,
               "Number of parts in a scene, the same of each model as far as it divides")
      .bounded("clutter", o.clutter, 0, 2,
               "What else lies on the board. 0: nothing; 1: printed shapes and 3 foreign parts; 2: "
               "many shapes and 8 foreign parts")
      .bounded("pile", o.pile, 0.0, 1.0,
               "How much the parts are piled up. 0: they lie apart; 1: all lie on one heap and "
               "hide each other");
  OptionTable(verb, "Image", level)
      .bounded("width", o.width, 16, 8192, "Width of the images, px")
      .bounded("height", o.height, 16, 8192, "Height of the images, px")
      .bounded("focal", o.focal_px, 1.0, 1e5, "Focal length of the camera, px")
      .level(OptionLevel::Expert)
      .bounded("blur", o.blur_px, 0.0, 10.0, "Standard deviation of the lens's blur, px")
      .bounded("noise", o.noise_grey, 0.0, 50.0,
               "Standard deviation of the sensor's noise, grey levels")
      .bounded("supersampling", o.supersampling, 1, 7, "Samples of a pixel along each axis; odd")
      .flag("shadows,!--no-shadows", o.shadows, "Cast shadows (default)");
}

}  // namespace edgescout
