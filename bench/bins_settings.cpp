#include "bench/bins_settings.h"

#include <CLI/CLI.hpp>
#include <filesystem>
#include <map>
#include <sstream>

#include "host/io/bop.h"
#include "host/io/mesh.h"
#include "host/render/parts.h"

namespace edgescout {

BinsSettings::BinsSettings() {
  render.width = 640;
  render.height = 480;
  render.focal_px = 760;
  render.pile = 0.7;
  scout.detect_in_every_image = false;
  scout.min_entropy_nats = 0;  // all strategies use up their views
}

namespace {

void add_scene_options(CLI::App& app, BinsSettings& s) {
  app.add_option("--out", s.out, "CSV to write")->required();
  app.add_flag("--resume", s.resume, "Keep what the CSV holds and add what is missing");
  app.add_option("--images", s.images, "Folder where rendered images are kept for the next run; none: nowhere");
  app.add_option("--scenes", s.scenes)->capture_default_str();
  app.add_option("--first-scene", s.first_scene)->capture_default_str();
  app.add_option("--parts", s.parts, "The project's own")->capture_default_str();
  app.add_option("--models", s.models, "CAD files in their place");
  app.add_option("--unit", s.unit, "Of the CAD files")->capture_default_str();
  app.add_option("--models-info", s.models_info, "Their symmetries: BOP's JSON, ids in the order of --models from 1");
  app.add_option("--fewest-parts", s.fewest_parts, "In a bin")->capture_default_str();
  app.add_option("--most-parts", s.most_parts)->capture_default_str();
  app.add_option("--pile", s.render.pile)->capture_default_str();
  app.add_option("--clutter", s.render.clutter)->capture_default_str();
  app.add_option("--width", s.render.width)->capture_default_str();
  app.add_option("--height", s.render.height)->capture_default_str();
  app.add_option("--focal", s.render.focal_px)->capture_default_str();
  app.add_option("--noise", s.render.noise_grey)->capture_default_str();
  app.add_option("--radius", s.hemisphere.radius_m, "Of the hemisphere of views, m")->capture_default_str();
  app.add_option("--views", s.hemisphere.count, "On it")->capture_default_str();
}

void add_detection_options(CLI::App& app, BinsSettings& s) {
  app.add_option("--device", s.device)->capture_default_str();
  app.add_option("--sought", s.sought, "Numbers of types searched for: 1, or as many as there are")->capture_default_str();
  app.add_option("--depth-margin", s.depth_margin_m, "Templates: distances around the radius, m")->capture_default_str();
  app.add_option("--frequency", s.templates.frequency)->capture_default_str();
  app.add_option("--in-plane-steps", s.templates.in_plane_steps)->capture_default_str();
  app.add_option("--distance-ratio", s.templates.distance_ratio)->capture_default_str();
  app.add_option("--aligned", s.scout.pipeline.detect.aligned)->capture_default_str();
  app.add_option("--registered", s.scout.pipeline.detect.candidates)->capture_default_str();
}

void add_scout_options(CLI::App& app, BinsSettings& s) {
  app.add_option("--strategies", s.strategies)->capture_default_str();
  app.add_option("--max-views", s.scout.max_views)->capture_default_str();
  app.add_flag("--detect-in-every-image", s.scout.detect_in_every_image, "Else in the first alone, as in the paper");
  app.add_option("--candidates", s.scout.max_candidates)->capture_default_str();
  app.add_option("--particles", s.scout.particles.count)->capture_default_str();
  app.add_option("--combinations", s.scout.combinations.count)->capture_default_str();
  app.add_option("--sharpness", s.scout.combinations.sharpness)->capture_default_str();
  app.add_option("--min-probability", s.scout.detections.min_probability, "Of reported instances")->capture_default_str();
  app.add_option("--map-reduction", s.scout.next_view.reduction)->capture_default_str();
  app.add_option("--chamfer-cap", s.scout.next_view.cap_px)->capture_default_str();
  app.add_option("--sigma", s.scout.next_view.sigma_px, "Of the next view's likelihood, px")->capture_default_str();
  app.add_option("--belief-sigma", s.scout.particles.sigma_px, "Of the particles' weights, px")->capture_default_str();
  app.add_flag("--literal", s.scout.next_view.literal, "The paper's own formula");
  app.add_option("--visibility", s.scout.particles.visibility.depth_map_size_px, "Side of the depth maps for the particles' visible points, px")->capture_default_str();
}

}  // namespace

void add_options(CLI::App& app, BinsSettings& settings) {
  add_scene_options(app, settings);
  add_detection_options(app, settings);
  add_scout_options(app, settings);
}

std::vector<Object> objects_of(const BinsSettings& s) {
  std::vector<Object> objects;
  if (s.models.empty())
    for (const std::string& part : s.parts) objects.push_back(make_part(part));
  std::map<int, Symmetries> symmetries;
  if (!s.models_info.empty()) symmetries = load_symmetries(s.models_info);
  for (const std::string& file : s.models) {
    const int id = static_cast<int>(objects.size()) + 1;
    objects.push_back({id, load_mesh(file, length_unit(s.unit)), symmetries[id]});
  }
  return objects;
}

std::string images_folder(const BinsSettings& s) {
  std::ostringstream name;
  for (const std::string& part : s.models.empty() ? s.parts : s.models) name << std::filesystem::path(part).stem().string() << '_';
  const RenderOptions& r = s.render;
  name << s.fewest_parts << '-' << s.most_parts << "_p" << r.pile << "_c" << r.clutter << '_' << r.width << 'x' << r.height << "_f" << r.focal_px << "_n" << r.noise_grey << "_r"
       << s.hemisphere.radius_m << "_v" << s.hemisphere.count << "_s" << r.seed;
  return s.images + "/" + name.str();
}

}  // namespace edgescout
