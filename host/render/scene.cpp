#include "host/render/scene.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "host/render/board.h"
#include "host/render/foreign_parts.h"
#include "host/render/materials.h"
#include "host/render/photographs.h"
#include "host/render/pile.h"
#include "host/render/scene_geometry.h"
#include "host/render/scene_lights.h"
#include "host/render/scene_views.h"
#include "kernels/error.h"

namespace edgescout {
namespace {

void add_targets(SimulatedScene& scene, Random random) {
  const int models = static_cast<int>(scene.objects.size());
  const int first = random.below(models);
  std::vector<Material> materials;
  for (int i = 0; i < models; ++i)
    materials.push_back(with_ranges(random_material(random), scene.options.surfaces,
                                    random.split("surface").split(i)));
  for (int i = 0; i < scene.options.objects; ++i) {
    PlacedObject part;
    part.object = (first + i) % models;
    part.material = materials[part.object];
    part.material.albedo *= random.uniform(0.9, 1.1);
    scene.placed.push_back(part);
  }
}

// Fisher-Yates shuffle, so that foreign parts lie below, between and above the targets.
std::vector<std::size_t> shuffled(std::size_t count, Random& random) {
  std::vector<std::size_t> order(count);
  for (std::size_t i = 0; i < count; ++i) order[i] = i;
  for (std::size_t i = count; i > 1; --i)
    std::swap(order[i - 1], order[random.below(static_cast<int>(i))]);
  return order;
}

// The table places origins and turns parts about them, so the mesh is moved to its middle first.
Se3 place_by_middle(PileTable& table, Mesh mesh, double radius_m, bool alone, Random& random) {
  const Eigen::Vector3d middle = middle_m(mesh);
  for (Eigen::Vector3d& vertex_m : mesh.vertices_m) vertex_m -= middle;
  Se3 pose = table.place(mesh, radius_m, alone, random);
  pose.translation_m -= pose.rotation * middle;
  return pose;
}

void lay_out(SimulatedScene& scene, double diameter_m, Random random) {
  const double crowd = std::sqrt(static_cast<double>(scene.placed.size()));
  const double radius = diameter_m * crowd * (0.65 - 0.35 * scene.options.pile);
  PileTable table(8 * diameter_m * crowd, diameter_m / 80);
  for (const std::size_t i : shuffled(scene.placed.size(), random)) {
    PlacedObject& part = scene.placed[i];
    const bool alone = random.uniform() >= scene.options.pile;
    part.world_from_object =
        place_by_middle(table, scene.objects[part.object].mesh, radius, alone, random);
  }
}

// A photograph in place of the desk. Each view has its own.
void add_backgrounds(SimulatedScene& scene, const PhotographFolders& photographs,
                     const Random& random) {
  if (photographs.empty()) return;
  if (random.split("background share").uniform() >= scene.options.clutter_ranges.background_share)
    return;
  for (std::size_t v = 0; v < scene.views.size(); ++v) {
    SceneView& view = scene.views[v];
    view.background = random_crop(photographs, view.camera.width, view.camera.height,
                                  random.split("background").split(v));
  }
}

// How finely and how far the views see the board.
struct BoardView {
  double pixel_m = std::numeric_limits<double>::infinity();  // finest
  double seen_m = 0;                                         // of the widest view
};

BoardView board_view(const SimulatedScene& scene) {
  BoardView seen;
  for (const SceneView& view : scene.views) {
    const double distance = view.camera_from_world.translation_m.norm();
    seen.pixel_m = std::min(seen.pixel_m, distance / view.camera.fx);
    seen.seen_m = std::max(
        seen.seen_m, distance / view.camera.fx * std::max(view.camera.width, view.camera.height));
  }
  return seen;
}

enum class BoardKind { Wide, Sheet, None };

// Before a background the board does not fill the view.
BoardKind random_board(const SimulatedScene& scene, double chance) {
  if (scene.views[0].background.pixels.empty())
    return chance < 0.35 ? BoardKind::Sheet : BoardKind::Wide;
  return chance < 0.6 ? BoardKind::Sheet : BoardKind::None;
}

// A photograph as the paper of the board, mirrored at its borders so that it covers all of it.
Image texture_paper(const PhotographFolders& photographs, int side_px, double seen_px,
                    const Random& random) {
  Random stream = random.split("texture size");
  const int tile_px = std::clamp(static_cast<int>(seen_px * stream.uniform(0.4, 1.2)), 16, side_px);
  return mirrored_tiles(random_crop(photographs, tile_px, tile_px, random.split("texture")),
                        side_px);
}

void print_on_board(SimulatedScene& scene, double diameter_m, const BoardView& view,
                    const PhotographFolders& textures, const Random& random) {
  constexpr double TEXELS_PER_PIXEL = 1.0;
  constexpr int LARGEST_PX = 4096;
  PrintOptions print;
  print.side_px = std::clamp(static_cast<int>(TEXELS_PER_PIXEL * scene.board_side_m / view.pixel_m),
                             64, LARGEST_PX);
  const double texels_per_m = print.side_px / scene.board_side_m;
  print.clutter = scene.options.clutter;
  print.smallest_px = 0.15 * (texels_per_m * diameter_m);
  print.largest_px = 1.6 * (texels_per_m * diameter_m);
  if (!textures.empty() &&
      random.split("texture share").uniform() < scene.options.clutter_ranges.board_texture_share)
    print.texture = texture_paper(textures, print.side_px, texels_per_m * view.seen_m, random);
  scene.board = print_board(print, random.split("board").split("print"));
}

// Either a wide board that fills the view, or a sheet whose own edges are seen.
void lay_board(SimulatedScene& scene, double diameter_m, const PhotographFolders& textures,
               const Random& random) {
  const BoardView view = board_view(scene);
  Random stream = random.split("board");
  const BoardKind kind = random_board(scene, stream.uniform());
  const double reach = reach_m(scene);
  scene.board_side_m =
      kind == BoardKind::Sheet ? reach * stream.uniform(2.0, 3.0) : 3 * view.seen_m;
  scene.world_from_board.rotation = so3_exp({0, 0, stream.uniform(0, 2 * std::numbers::pi)});
  if (kind == BoardKind::Sheet)
    scene.world_from_board.translation_m = {0.3 * reach * stream.normal(),
                                            0.3 * reach * stream.normal(), 0};
  scene.desk_albedo = std::pow(stream.uniform(0.2, 0.8), 2);
  scene.board_material = board_material(scene.board_material, scene.options.surfaces, random);
  if (kind == BoardKind::None)
    scene.board_side_m = 0;
  else
    print_on_board(scene, diameter_m, view, textures, random);
}

}  // namespace

SimulatedScene make_scene(std::span<const Object> objects, const RenderOptions& options,
                          const SceneFiles& files) {
  options.validate();
  if (objects.empty()) throw InputError("render: found no model, expected at least one");
  for (const Object& object : objects)
    if (object.mesh.triangles.empty())
      throw InputError(object.mesh.name, "triangles", "none", "at least one");
  const Random random(options.seed);
  const double diameter_m = mean_diameter_m(objects);
  SimulatedScene scene;
  scene.options = options;
  scene.objects.assign(objects.begin(), objects.end());
  add_targets(scene, random.split("targets"));
  add_foreign_parts(scene, files.clutter, diameter_m, random);
  lay_out(scene, diameter_m, random.split("poses"));
  add_views(scene, diameter_m, random);
  add_occluders(scene, files.clutter, diameter_m, random);
  add_backgrounds(scene, files.backgrounds, random);
  add_lights(scene, files.environments, random);
  lay_board(scene, diameter_m, files.board_textures, random);
  return scene;
}

}  // namespace edgescout
