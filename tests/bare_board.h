// Parts on a bare board, 0.3 m away in a small image: what the tests of whole chains look at, and
// the templates that suffice for it.
#pragma once

#include "host/model/template_set.h"
#include "host/render/scene.h"

namespace edgescout::test {

inline RenderOptions bare_board(int objects = 1, int views = 1) {
  RenderOptions options;
  options.width = 320;
  options.height = 240;
  options.focal_px = 400;
  options.objects = objects;
  options.views = views;
  options.clutter = 0;
  options.min_distance_m = options.max_distance_m = 0.3;
  return options;
}

inline TemplateOptions near_templates(double depth_margin_m) {
  TemplateOptions options;
  options.frequency = 3;
  options.in_plane_steps = 12;
  options.distance_min_m = 0.3 - depth_margin_m;
  options.distance_max_m = 0.3 + depth_margin_m;
  return options;
}

}  // namespace edgescout::test
