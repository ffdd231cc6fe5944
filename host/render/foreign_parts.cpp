#include "host/render/foreign_parts.h"

#include <cmath>

#include "host/render/materials.h"
#include "host/render/parts.h"
#include "host/render/scene_geometry.h"

namespace edgescout {
namespace {

Mesh simple_part(double diameter_m, Random& random) {
  const double size = diameter_m * random.uniform(0.5, 1.0);
  switch (random.below(4)) {
    case 0:
      return make_bar(size * random.uniform(0.08, 0.25), size);
    case 1: {
      const double height = size * random.uniform(0.15, 0.4);
      return make_ring(0.5 * size, 0.5 * size * random.uniform(0.4, 0.8), height);
    }
    case 2:
      return make_box(
          {size * 1.2, size * random.uniform(0.15, 0.35), size * random.uniform(0.1, 0.25)});
    default:
      return make_box(
          {size * 0.8, size * random.uniform(0.3, 0.8), size * random.uniform(0.1, 0.5)});
  }
}

Mesh scaled_to(Mesh mesh, double diameter_m) {
  const double factor = diameter_m / mesh.diameter_m;
  for (Eigen::Vector3d& vertex_m : mesh.vertices_m) vertex_m *= factor;
  mesh.box_min_m *= factor;
  mesh.box_max_m *= factor;
  mesh.diameter_m = diameter_m;
  return mesh;
}

Mesh file_part(std::span<const Mesh> files, const Range& size, double diameter_m, Random& random) {
  const Mesh& mesh = files[random.below(static_cast<int>(files.size()))];
  return scaled_to(mesh, diameter_m * draw(size, random));
}

PlacedObject& add_part(SimulatedScene& scene, Mesh mesh, const Material& material) {
  PlacedObject part;
  part.object = static_cast<int>(scene.objects.size());
  part.target = false;
  part.material = material;
  scene.objects.push_back({0, std::move(mesh), {}});
  scene.placed.push_back(part);
  return scene.placed.back();
}

int draw_count(const Range& range, Random& random) {
  return static_cast<int>(std::floor(random.uniform(range.low, range.high + 1)));
}

void add_simple_parts(SimulatedScene& scene, double diameter_m, Random random) {
  constexpr int COUNT[] = {0, 3, 8};
  for (int i = 0; i < COUNT[scene.options.clutter]; ++i) {
    const Material material = random_material(random);
    add_part(scene, simple_part(diameter_m, random),
             with_ranges(material, scene.options.surfaces, random.split("surface").split(i)));
  }
}

void add_file_parts(SimulatedScene& scene, std::span<const Mesh> files, double diameter_m,
                    Random random) {
  const ClutterRanges& ranges = scene.options.clutter_ranges;
  const int count = draw_count(ranges.file_parts, random);
  for (int i = 0; i < count; ++i) {
    const Material material = random_material(random);
    add_part(scene, file_part(files, ranges.size, diameter_m, random),
             with_ranges(material, scene.options.surfaces, random.split("surface").split(i)));
  }
}

// On the line from a camera to a target, somewhat beside it.
Eigen::Vector3d place_before(const SimulatedScene& scene, double nearness, double diameter_m,
                             Random& random) {
  const SceneView& view = scene.views[random.below(static_cast<int>(scene.views.size()))];
  const PlacedObject& target = random_target(scene, random);
  const Eigen::Vector3d aim_m =
      target.world_from_object * middle_m(scene.objects[target.object].mesh) +
      0.5 * diameter_m * random.direction();
  const Eigen::Vector3d eye_m = inverse(view.camera_from_world).translation_m;
  return eye_m + nearness * (aim_m - eye_m);
}

}  // namespace

void add_foreign_parts(SimulatedScene& scene, std::span<const Mesh> files, double diameter_m,
                       const Random& random) {
  if (files.empty())
    add_simple_parts(scene, diameter_m, random.split("foreign"));
  else
    add_file_parts(scene, files, diameter_m, random.split("foreign files"));
}

void add_occluders(SimulatedScene& scene, std::span<const Mesh> files, double diameter_m,
                   const Random& random) {
  constexpr Range NEARNESS{0.4, 0.85};  // 0: at the camera; 1: at the target
  Random stream = random.split("occluders");
  const ClutterRanges& ranges = scene.options.clutter_ranges;
  const int count = draw_count(ranges.occluders, stream);
  for (int i = 0; i < count; ++i) {
    const double nearness = draw(NEARNESS, stream);
    // Seen as large as a part on the board.
    const double size_m = nearness * diameter_m;
    Mesh mesh =
        files.empty() ? simple_part(size_m, stream) : file_part(files, ranges.size, size_m, stream);
    const Material material = random_material(stream);
    const Eigen::Quaterniond rotation = stream.rotation();
    const Eigen::Vector3d middle = place_before(scene, nearness, diameter_m, stream);
    const Eigen::Vector3d origin_m = middle - rotation * middle_m(mesh);
    PlacedObject& part =
        add_part(scene, std::move(mesh),
                 with_ranges(material, scene.options.surfaces, stream.split("surface").split(i)));
    part.world_from_object = {rotation, origin_m};
    part.hangs = true;
  }
}

}  // namespace edgescout
