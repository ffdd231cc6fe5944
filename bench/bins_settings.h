// What the benchmark of rendered bins is run with: the paper's sizes and images small enough for thirty bins in half an hour, all to be overridden.
#pragma once

#include <string>
#include <vector>

#include "host/active/scout.h"
#include "host/active/views.h"
#include "host/render/scene.h"

namespace CLI {
class App;
}

namespace edgescout {

struct BinsSettings {
  std::string out, images, device = "cpu", unit = "mm", models_info;
  std::vector<std::string> parts{"l_bracket", "bearing_block", "u_channel"}, models, strategies{"mi-max", "random", "dis", "fixed"};
  std::vector<int> sought{1, 3};
  int scenes = 30, first_scene = 0, fewest_parts = 5, most_parts = 20;
  bool resume = false;
  double depth_margin_m = 0.12;  // of the parts around the hemisphere's radius
  RenderOptions render;
  HemisphereOptions hemisphere;
  TemplateOptions templates;
  ScoutOptions scout;
  BinsSettings();
};

void add_options(CLI::App& app, BinsSettings& settings);

// The types, `settings.models` where given, else the project's own parts. Call after parsing.
std::vector<Object> objects_of(const BinsSettings& settings);

// Names all that a bin's images depend on: the folder where they are kept between runs, below settings.images.
std::string images_folder(const BinsSettings& settings);

}  // namespace edgescout
