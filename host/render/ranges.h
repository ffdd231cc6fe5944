// Ranges of what real images have and the plain renderer leaves out.
//
// Every value is drawn evenly from its range, by a random stream of its own: for a scene, a model
// or an image. The defaults draw nothing and change nothing.
#pragma once

#include "host/core/options.h"
#include "host/core/random.h"

namespace edgescout {

inline double draw(const Range& range, Random& random) {
  return random.uniform(range.low, range.high);
}

// What lies and hangs around the parts, and how large these are in the image.
struct ClutterRanges {
  // Foreign parts from files (SceneFiles::clutter). Their number, and diameter over that of the
  // parts.
  Range file_parts{3, 8};
  Range size{0.5, 1.5};
  Range occluders;  // foreign parts that hang between cameras and parts
  // Pixels that the parts' mean diameter spans, evenly over the octaves; sets the distance of the
  // cameras. 0: not used.
  Range span_px;
  double background_share = 1;     // of the scenes, with SceneFiles::backgrounds
  double board_texture_share = 1;  // of the scenes, with SceneFiles::board_textures
};
void describe(ClutterRanges& ranges, OptionVisitor& visit);

// Surfaces that reflect their surroundings: metal and gloss (reflection.h).
struct SurfaceRanges {
  double metal = 0;             // share of the models that are bare metal
  Range reflectance{0.5, 0.9};  // of metal at normal incidence
  Range roughness{0.1, 0.4};    // of metal and gloss
  Range anisotropy;             // of metal: 0 even, 0.9 brushed
  Range gloss;                  // reflectance at normal incidence of parts that are not metal
  Range board_gloss;            // the same of the board
  Range albedo;                 // of parts that are not metal; 0: that of plain scenes
  bool reflect() const { return metal > 0 || gloss.high > 0 || board_gloss.high > 0; }
};
void describe(SurfaceRanges& ranges, OptionVisitor& visit);

// 0: as in plain scenes.
struct LightRanges {
  Range lamp_width;  // radius of a lamp over its distance
  Range lamp_share;  // of the light; the rest comes from all sides
};
void describe(LightRanges& ranges, OptionVisitor& visit);

// Lens, sensor and the camera's own processing (camera_effects.h).
struct CameraRanges {
  Range brightness{1, 1};  // factor on the light
  Range contrast{1, 1};    // factor on grey about the image's mean
  Range gamma{2.2, 2.2};
  Range lens_residue_px;  // shift of the image's corner, away from the centre
  Range defocus_px;       // radius of the disc
  Range motion_px;        // length of the blur
  Range vignetting;       // share of the light that the corner loses
  Range noise_grey;       // standard deviation at grey 128, beside RenderOptions::noise_grey
  Range sharpening;       // amount of the unsharp mask
  Range sharpening_radius_px{1, 1};
  Range jpeg_quality;  // 0: not compressed
};
void describe(CameraRanges& ranges, OptionVisitor& visit);

}  // namespace edgescout
