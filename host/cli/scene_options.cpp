#include "host/cli/scene_options.h"

namespace edgescout {

void add_scene_options(CLI::App& verb, RenderOptions& o) {
  OptionTable(verb, "Scene")
      .bounded("seed", o.seed, 0u, 4000000000u, "Scene i is that of seed + i")
      .bounded("objects", o.objects, 1, 20, "Instances a scene, dealt evenly over the models")
      .bounded("clutter", o.clutter, 0, 2,
               "0: bare board; 1: printed shapes and 3 foreign parts; 2: many and 8")
      .bounded("pile", o.pile, 0.0, 1.0, "0: parts lie apart; 1: all on one heap, hiding each other");
  OptionTable(verb, "Image")
      .bounded("width", o.width, 16, 8192, "px")
      .bounded("height", o.height, 16, 8192, "px")
      .bounded("focal", o.focal_px, 1.0, 1e5, "Focal length, px")
      .bounded("blur", o.blur_px, 0.0, 10.0, "Standard deviation of the lens's Gaussian, px")
      .bounded("noise", o.noise_grey, 0.0, 50.0, "Standard deviation of the sensor's noise, grey levels")
      .bounded("supersampling", o.supersampling, 1, 7, "Samples a pixel and axis; odd")
      .flag("shadows,!--no-shadows", o.shadows, "Cast shadows (default)");
}

}  // namespace edgescout
