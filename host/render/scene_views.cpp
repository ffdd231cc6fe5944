#include "host/render/scene_views.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "host/render/scene_geometry.h"

namespace edgescout {
namespace {

// Where a camera stands: its aim on the board or at a target, and its place as seen from there.
struct Viewpoint {
  double azimuth_rad = 0, elevation_rad = 0, distance_m = 0, roll_rad = 0;
  Eigen::Vector3d aim_m;
};

Se3 look_at(const Viewpoint& from) {
  const Eigen::Vector3d eye_m =
      from.aim_m + from.distance_m * on_sphere(from.azimuth_rad, from.elevation_rad);
  const Eigen::Vector3d forward = (from.aim_m - eye_m).normalized();
  const Eigen::Vector3d level(-std::sin(from.azimuth_rad), std::cos(from.azimuth_rad), 0);
  const Eigen::Vector3d right = (level - level.dot(forward) * forward).normalized();
  Eigen::Matrix3d camera_from_world;
  camera_from_world << right.transpose(), forward.cross(right).transpose(), forward.transpose();
  const Se3 turned{Eigen::Quaterniond(Eigen::AngleAxisd(from.roll_rad, Eigen::Vector3d::UnitZ()) *
                                      camera_from_world),
                   {0, 0, 0}};
  return {turned.rotation.normalized(), -(turned.rotation * eye_m)};
}

Viewpoint random_viewpoint(const RenderOptions& o, int view, double first_azimuth_rad, double reach,
                           Random& random) {
  const double filling_m = o.focal_px * reach / (0.5 * std::min(o.width, o.height));
  const bool given = o.max_distance_m > 0;
  Viewpoint from;
  // The golden angle keeps any number of views apart.
  from.azimuth_rad = first_azimuth_rad + view * std::numbers::pi * (3 - std::sqrt(5.0)) +
                     random.uniform(-0.2, 0.2);
  from.elevation_rad =
      random.uniform(o.min_elevation_deg, o.max_elevation_deg) * std::numbers::pi / 180;
  from.distance_m = random.uniform(given ? o.min_distance_m : 0.8 * filling_m,
                                   given ? o.max_distance_m : 1.2 * filling_m);
  const double aim_y = 0.1 * reach * random.normal();
  from.aim_m = {0.1 * reach * random.normal(), aim_y, 0};
  from.roll_rad = random.uniform(-0.3, 0.3);
  return from;
}

// Aims beside a random target, from the distance at which it spans a number of pixels.
void aim_at_target(Viewpoint& from, const SimulatedScene& scene, double diameter_m, Random random) {
  const RenderOptions& o = scene.options;
  const Range& span_px = o.clutter_ranges.span_px;
  const double octaves = std::log2(span_px.high / span_px.low);
  from.distance_m = o.focal_px * diameter_m / (span_px.low * std::exp2(octaves * random.uniform()));
  const PlacedObject& target = random_target(scene, random);
  const double beside_m = 0.3 * std::min(o.width, o.height) * from.distance_m / o.focal_px;
  from.aim_m = target.world_from_object * middle_m(scene.objects[target.object].mesh);
  for (int axis = 0; axis < 2; ++axis) from.aim_m[axis] += beside_m * random.uniform(-1, 1);
}

}  // namespace

void add_views(SimulatedScene& scene, double diameter_m, const Random& random) {
  const RenderOptions& o = scene.options;
  const double reach = reach_m(scene);
  Random stream = random.split("views");
  const double first_azimuth_rad = stream.uniform(0, 2 * std::numbers::pi);
  for (int i = 0; i < o.views; ++i) {
    Viewpoint from = random_viewpoint(o, i, first_azimuth_rad, reach, stream);
    if (o.clutter_ranges.span_px.high > 0)
      aim_at_target(from, scene, diameter_m, random.split("span").split(i));
    SceneView view;
    view.camera.width = o.width;
    view.camera.height = o.height;
    view.camera.fx = view.camera.fy = o.focal_px;
    view.camera.cx = 0.5 * (o.width - 1);
    view.camera.cy = 0.5 * (o.height - 1);
    view.camera_from_world = look_at(from);
    scene.views.push_back(view);
  }
}

}  // namespace edgescout
