#include "host/render/scene.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "host/render/board.h"
#include "host/render/parts.h"
#include "host/render/pile.h"
#include "kernels/error.h"

namespace edgescout {
namespace {

constexpr double PI = std::numbers::pi;

double mean_diameter_m(std::span<const Object> objects) {
  double sum = 0;
  for (const Object& object : objects) sum += object.mesh.diameter_m;
  return sum / static_cast<double>(objects.size());
}

Eigen::Vector3d on_sphere(double azimuth_rad, double elevation_rad) {
  return {std::cos(elevation_rad) * std::cos(azimuth_rad),
          std::cos(elevation_rad) * std::sin(azimuth_rad), std::sin(elevation_rad)};
}

// Materials of a workshop: bare metal, dark plastic, light plastic.
Material random_material(Random& random) {
  switch (random.below(3)) {
    case 0:
      return {random.uniform(0.18, 0.45), random.uniform(0.1, 0.35), random.uniform(15, 60)};
    case 1:
      return {random.uniform(0.02, 0.10), random.uniform(0.02, 0.08), random.uniform(10, 40)};
    default:
      return {random.uniform(0.35, 0.75), random.uniform(0.0, 0.06), random.uniform(10, 40)};
  }
}

Mesh foreign_part(double diameter_m, Random& random) {
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

void add_foreign_parts(SimulatedScene& scene, double diameter_m, Random random) {
  constexpr int COUNT[] = {0, 3, 8};
  for (int i = 0; i < COUNT[scene.options.clutter]; ++i) {
    PlacedObject part;
    part.object = static_cast<int>(scene.objects.size());
    part.target = false;
    part.material = random_material(random);
    scene.objects.push_back({0, foreign_part(diameter_m, random), {}});
    scene.placed.push_back(part);
  }
}

void add_targets(SimulatedScene& scene, Random random) {
  const int models = static_cast<int>(scene.objects.size());
  const int first = random.below(models);
  std::vector<Material> materials;
  for (int i = 0; i < models; ++i) materials.push_back(random_material(random));
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

// The middle of the mesh in its own frame, if that is not the origin.
Eigen::Vector3d middle_m(const Mesh& mesh) {
  const Eigen::Vector3d box_m = (mesh.box_min_m + mesh.box_max_m) / 2;
  return box_m.norm() < 1e-6 * mesh.diameter_m ? Eigen::Vector3d::Zero() : box_m;
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

// Radius about the origin that contains the centres of all targets and half their size.
double reach_m(const SimulatedScene& scene) {
  double reach = 0;
  for (const PlacedObject& part : scene.placed) {
    const Mesh& mesh = scene.objects[part.object].mesh;
    if (part.target)
      reach = std::max(reach, (part.world_from_object * middle_m(mesh)).head<2>().norm() +
                                  0.5 * mesh.diameter_m);
  }
  return reach;
}

Se3 look_at(const Eigen::Vector3d& eye_m, const Eigen::Vector3d& target_m, double azimuth_rad,
            double roll_rad) {
  const Eigen::Vector3d forward = (target_m - eye_m).normalized();
  const Eigen::Vector3d level(-std::sin(azimuth_rad), std::cos(azimuth_rad), 0);
  const Eigen::Vector3d right = (level - level.dot(forward) * forward).normalized();
  Eigen::Matrix3d camera_from_world;
  camera_from_world << right.transpose(), forward.cross(right).transpose(), forward.transpose();
  const Se3 turned{
      Eigen::Quaterniond(Eigen::AngleAxisd(roll_rad, Eigen::Vector3d::UnitZ()) * camera_from_world),
      {0, 0, 0}};
  return {turned.rotation.normalized(), -(turned.rotation * eye_m)};
}

void add_views(SimulatedScene& scene, Random random) {
  const RenderOptions& o = scene.options;
  const double reach = reach_m(scene);
  const double filling_m = o.focal_px * reach / (0.5 * std::min(o.width, o.height));
  const bool given = o.max_distance_m > 0;
  const double low = given ? o.min_distance_m : 0.8 * filling_m,
               high = given ? o.max_distance_m : 1.2 * filling_m;
  const double first_azimuth = random.uniform(0, 2 * PI);
  for (int i = 0; i < o.views; ++i) {
    // The golden angle keeps any number of views apart.
    const double azimuth =
        first_azimuth + i * PI * (3 - std::sqrt(5.0)) + random.uniform(-0.2, 0.2);
    const double elevation = random.uniform(o.min_elevation_deg, o.max_elevation_deg) * PI / 180;
    const double distance = random.uniform(low, high);
    const double target_y = 0.1 * reach * random.normal();
    const Eigen::Vector3d target(0.1 * reach * random.normal(), target_y, 0);
    SceneView view;
    view.camera.width = o.width;
    view.camera.height = o.height;
    view.camera.fx = view.camera.fy = o.focal_px;
    view.camera.cx = 0.5 * (o.width - 1);
    view.camera.cy = 0.5 * (o.height - 1);
    view.camera_from_world = look_at(target + distance * on_sphere(azimuth, elevation), target,
                                     azimuth, random.uniform(-0.3, 0.3));
    scene.views.push_back(view);
  }
}

// Adds a lamp of some width: a cluster of points, which makes the border of its shadows soft.
void add_lamp(SimulatedScene& scene, double irradiance, double reach, Random& random) {
  constexpr int POINTS = 8;
  const double distance = reach * random.uniform(4, 9);
  const double elevation = random.uniform(0.6, 1.35);
  const Eigen::Vector3d centre = distance * on_sphere(random.uniform(0, 2 * PI), elevation);
  const double width = distance * random.uniform(0.03, 0.15);
  for (int i = 0; i < POINTS; ++i)
    scene.lights.push_back({centre + width * random.direction(), irradiance / POINTS, 640});
}

void add_lights(SimulatedScene& scene, Random random) {
  const double reach = reach_m(scene);
  const double exposure = random.uniform(0.75, 1.3);
  const double lamps = exposure * random.uniform(0.4, 0.75), share = random.uniform(0.55, 0.85);
  add_lamp(scene, lamps * share, reach, random);
  add_lamp(scene, lamps * (1 - share), reach, random);
  constexpr int SKY = 40;
  for (int i = 0; i < SKY; ++i) {
    // Equal areas of the upper hemisphere; the mean cosine on the board is a half.
    const double elevation = std::asin((i + 0.5) / SKY);
    const Eigen::Vector3d direction = on_sphere(i * PI * (3 - std::sqrt(5.0)), elevation);
    scene.lights.push_back({20 * reach * direction, 2 * (exposure - lamps) / SKY, 224});
  }
  scene.ambient = 0.06 * exposure;
}

// Either a wide board that fills the view, or a sheet whose own edges are seen.
void lay_board(SimulatedScene& scene, double diameter_m, Random random) {
  constexpr double TEXELS_PER_PIXEL = 1.0;
  constexpr int LARGEST_PX = 4096;
  double pixel_m = std::numeric_limits<double>::infinity(), seen_m = 0;
  for (const SceneView& view : scene.views) {
    const double distance = view.camera_from_world.translation_m.norm();
    pixel_m = std::min(pixel_m, distance / view.camera.fx);
    seen_m = std::max(seen_m,
                      distance / view.camera.fx * std::max(view.camera.width, view.camera.height));
  }
  const bool sheet = random.uniform() < 0.35;
  const double reach = reach_m(scene);
  scene.board_side_m = sheet ? reach * random.uniform(2.0, 3.0) : 3 * seen_m;
  scene.world_from_board.rotation = so3_exp({0, 0, random.uniform(0, 2 * PI)});
  if (sheet)
    scene.world_from_board.translation_m = {0.3 * reach * random.normal(),
                                            0.3 * reach * random.normal(), 0};
  scene.desk_albedo = std::pow(random.uniform(0.2, 0.8), 2);
  const int side_px =
      std::clamp(static_cast<int>(TEXELS_PER_PIXEL * scene.board_side_m / pixel_m), 64, LARGEST_PX);
  const double texels = side_px / scene.board_side_m * diameter_m;
  scene.board = print_board(side_px, scene.options.clutter, 0.15 * texels, 1.6 * texels,
                            random.split("print"));
}

}  // namespace

SimulatedScene make_scene(std::span<const Object> objects, const RenderOptions& options) {
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
  add_foreign_parts(scene, diameter_m, random.split("foreign"));
  lay_out(scene, diameter_m, random.split("poses"));
  add_views(scene, random.split("views"));
  add_lights(scene, random.split("lights"));
  lay_board(scene, diameter_m, random.split("board"));
  return scene;
}

}  // namespace edgescout
