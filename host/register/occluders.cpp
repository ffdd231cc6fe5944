#include "host/register/occluders.h"

#include <algorithm>
#include <cmath>

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

// The farthest of the measured pixels of each pixel of the map: of noise and holes no occluder is
// made. Empty where fewer than half of them are measured.
void draw_measured(const MeasuredDepth& depth, Occluders& occluders) {
  const Camera& map = occluders.camera;
  const int side = int(REDUCTION);
  for (int y = 0; y < map.height; ++y)
    for (int x = 0; x < map.width; ++x) {
      float farthest_m = DEPTH_MISSING;
      int measured = 0;
      for (int v = side * y; v < std::min(side * (y + 1), depth.image.height); ++v)
        for (int u = side * x; u < std::min(side * (x + 1), depth.image.width); ++u) {
          farthest_m = std::max(farthest_m, depth.image.at(u, v));
          measured += depth.image.at(u, v) > 0;
        }
      if (2 * measured < side * side) continue;
      float& nearest_m =
          occluders.depth_m[std::size_t(y) * std::size_t(map.width) + std::size_t(x)];
      nearest_m = std::min(nearest_m,
                           farthest_m + float(OCCLUDING_SIGMAS * depth.noise.sigma_m(farthest_m)));
    }
}

// How many of the 3 x 3 pixels around a point's projection show something nearer. 0 outside the
// image.
int nearer_around(const Occluders& occluders, const Eigen::Vector3d& in_camera,
                  double tolerance_m) {
  const Camera& camera = occluders.camera;
  if (in_camera.z() <= 0) return 0;
  const Eigen::Vector2d pixel = project(camera, in_camera).array().round();
  if (!(pixel.x() >= 1 && pixel.y() >= 1 && pixel.x() < camera.width - 1 &&
        pixel.y() < camera.height - 1))
    return 0;
  const float limit = float(in_camera.z() - tolerance_m);
  const std::size_t width = std::size_t(camera.width),
                    middle = std::size_t(pixel.y()) * width + std::size_t(pixel.x());
  int nearer = 0;
  for (const std::size_t row : {middle - width, middle, middle + width})
    for (const std::size_t i : {row - 1, row, row + 1}) nearer += occluders.depth_m[i] < limit;
  return nearer;
}

}  // namespace

bool Occluders::hide(const Eigen::Vector3d& in_camera, double tolerance_m) const {
  return nearer_around(*this, in_camera, tolerance_m) == 9;
}

bool Occluders::may_hide(const Eigen::Vector3d& in_camera, double tolerance_m) const {
  return nearer_around(*this, in_camera, tolerance_m) > 0;
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
