#include "host/register/occluders.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "host/register/measured_depth.h"

namespace edgescout {

namespace {

constexpr double REDUCTION = 2;     // image px per map px: edges of occluders are not better known
constexpr double TOLERANCE = 0.05;  // of the hidden object's diameter

void draw(const EdgeModel& model, std::span<const Se3> camera_from_object, Occluders& occluders,
          Backend& backend) {
  const Camera& c = occluders.camera;
  std::vector<float> depth_m(occluders.depth_m.size());  // of one pose alone
  for (const Se3& pose : camera_from_object) {
    if ((pose * model.center_m).z() <= model.radius_m) continue;
    const DepthJob job{to_pose(pose), intrinsics_of(c)};
    backend.depth_raster(model.triangle_mesh(), {&job, 1}, c.width, c.height, depth_m);
    std::ranges::transform(depth_m, occluders.depth_m, occluders.depth_m.begin(),
                           [](float a, float b) { return std::min(a, b); });
  }
}

constexpr double OCCLUDING_SIGMAS = 3;

// The measured surface in one pixel of the map: the farthest of its pixels in the image, farther by
// the sensor's error. Of noise and holes no occluder is made: DEPTH_EMPTY where fewer than half of
// them are measured.
float measured_in_map_m(const MeasuredDepth& depth, int x, int y) {
  const int side = int(REDUCTION);
  float farthest_m = DEPTH_MISSING;
  int measured = 0;
  for (int v = side * y; v < std::min(side * (y + 1), depth.image.height); ++v)
    for (int u = side * x; u < std::min(side * (x + 1), depth.image.width); ++u) {
      farthest_m = std::max(farthest_m, depth.image.at(u, v));
      measured += depth.image.at(u, v) > 0;
    }
  if (2 * measured < side * side) return DEPTH_EMPTY;
  return farthest_m + float(OCCLUDING_SIGMAS * depth.noise.sigma_m(farthest_m));
}

void draw_measured(const MeasuredDepth& depth, Occluders& occluders) {
  const Camera& map = occluders.camera;
  for (int y = 0; y < map.height; ++y)
    for (int x = 0; x < map.width; ++x) {
      float& nearest_m =
          occluders.depth_m[std::size_t(y) * std::size_t(map.width) + std::size_t(x)];
      nearest_m = std::min(nearest_m, measured_in_map_m(depth, x, y));
    }
}

struct MapPixel {
  int x, y;
};

// The pixel of a map that shows a point; empty on the map's border and outside.
std::optional<MapPixel> map_pixel(const Camera& map, const Eigen::Vector3d& in_camera) {
  if (in_camera.z() <= 0) return {};
  const Eigen::Vector2d pixel = project(map, in_camera).array().round();
  if (!(pixel.x() >= 1 && pixel.y() >= 1 && pixel.x() < map.width - 1 &&
        pixel.y() < map.height - 1))
    return {};
  return MapPixel{int(pixel.x()), int(pixel.y())};
}

// Whether test(x, y) holds for one of the 3 x 3 pixels around.
template <typename Test>
bool any_around(const MapPixel& middle, const Test& test) {
  for (int y = middle.y - 1; y <= middle.y + 1; ++y)
    for (int x = middle.x - 1; x <= middle.x + 1; ++x)
      if (test(x, y)) return true;
  return false;
}

float depth_at_m(const Occluders& occluders, int x, int y) {
  return occluders.depth_m[std::size_t(y) * std::size_t(occluders.camera.width) + std::size_t(x)];
}

}  // namespace

bool Occluders::hide(const Eigen::Vector3d& in_camera, double tolerance_m) const {
  const std::optional<MapPixel> at = map_pixel(camera, in_camera);
  const float limit = float(in_camera.z() - tolerance_m);
  return at && !any_around(*at, [&](int x, int y) { return depth_at_m(*this, x, y) >= limit; });
}

void remove_hidden(std::vector<ModelPoint>& points, const Occluders& occluders,
                   const Se3& camera_from_object, double tolerance_m, SilhouetteMarks* marks) {
  std::size_t kept = 0;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const Eigen::Vector3d point_m(points[i].x_m, points[i].y_m, points[i].z_m);
    if (occluders.hide(camera_from_object * point_m, tolerance_m)) continue;
    points[kept] = points[i];
    if (marks) (*marks)[kept] = (*marks)[i];
    ++kept;
  }
  points.resize(kept);
  if (marks) marks->resize(kept);
}

void remove_hidden(std::vector<ModelPoint>& points, const MeasuredDepth& depth,
                   const Camera& camera, const Se3& camera_from_object, double tolerance_m) {
  const Camera map = scaled(camera, 1 / REDUCTION);
  std::erase_if(points, [&](const ModelPoint& point) {
    const Eigen::Vector3d in_camera =
        camera_from_object * Eigen::Vector3d(point.x_m, point.y_m, point.z_m);
    const std::optional<MapPixel> at = map_pixel(map, in_camera);
    const float limit = float(in_camera.z() - tolerance_m);
    return at &&
           !any_around(*at, [&](int x, int y) { return measured_in_map_m(depth, x, y) >= limit; });
  });
}

std::shared_ptr<const Occluders> make_occluders(std::span<const EdgeModel> models,
                                                std::span<const ObjectPose> known,
                                                const ObjectView& view, Backend& backend) {
  if (known.empty() && !view.depth) return nullptr;
  auto occluders = std::make_shared<Occluders>();
  occluders->camera = scaled(view.camera, 1 / REDUCTION);
  occluders->depth_m.assign(
      std::size_t(occluders->camera.width) * std::size_t(occluders->camera.height), DEPTH_EMPTY);
  for (std::size_t object = 0; object < models.size(); ++object) {
    std::vector<Se3> poses;
    for (const ObjectPose& pose : known)
      if (pose.object == int(object))
        poses.push_back(view.camera_from_world * pose.world_from_object);
    draw(models[object], poses, *occluders, backend);
  }
  if (view.depth) draw_measured(*view.depth, *occluders);
  return occluders;
}

double occlusion_tolerance_m(const EdgeModel& model) { return TOLERANCE * model.mesh.diameter_m; }

}  // namespace edgescout
