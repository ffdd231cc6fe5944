#include "host/active/views.h"

#include <fmt/format.h>

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "host/io/files.h"
#include "host/io/json_fields.h"
#include "kernels/error.h"

namespace edgescout {

namespace {

constexpr double RADIANS = std::numbers::pi / 180;

// The number of cameras of each ring: in proportion to its circumference, rounded by largest
// remainders, at least one.
std::vector<int> share_among_rings(const HemisphereOptions& options) {
  std::vector<double> weight;
  double total = 0;
  for (const double elevation : options.elevations_deg)
    total += weight.emplace_back(std::max(1e-6, std::cos(elevation * RADIANS)));
  std::vector<int> share(weight.size(), 1);
  for (int given = int(share.size()); given < options.count; ++given) {
    std::size_t next = 0;
    const auto missing = [&](std::size_t ring) {
      return options.count * weight[ring] / total - share[ring];
    };
    for (std::size_t ring = 1; ring < share.size(); ++ring)
      if (missing(ring) > missing(next) + 1e-12) next = ring;
    ++share[next];
  }
  return share;
}

bool is_same_view(const Se3& a, const Se3& b) {
  const Eigen::Vector3d eye_a = inverse(a).translation_m, eye_b = inverse(b).translation_m;
  return (eye_a - eye_b).norm() < 1e-4 && angle_between_rad(a, b) < 1e-4;
}

}  // namespace

Se3 look_at(const Eigen::Vector3d& eye_m, const Eigen::Vector3d& target_m) {
  const double distance_m = (target_m - eye_m).norm();
  if (!(distance_m > 1e-9) || !std::isfinite(distance_m))
    throw InputError(
        "view: found a camera at the point it looks at, expected two different points");
  const Eigen::Vector3d forward = (target_m - eye_m) / distance_m;
  const bool steep = std::abs(forward.z()) > 1 - 1e-9;
  const Eigen::Vector3d up = steep ? Eigen::Vector3d::UnitY() : Eigen::Vector3d::UnitZ();
  const Eigen::Vector3d right = forward.cross(up).normalized();
  Eigen::Matrix3d camera_from_world;
  camera_from_world << right.transpose(), forward.cross(right).transpose(), forward.transpose();
  return se3_from_matrix(camera_from_world, -camera_from_world * eye_m);
}

void HemisphereOptions::validate() const {
  const auto fail = [](const char* field, const std::string& found, const char* expected) {
    throw InputError("options", std::string("views.") + field, found, expected);
  };
  if (!center_m.allFinite()) fail("center", "a number that is not finite", "a point");
  if (!(radius_m > 0 && radius_m <= 1000))
    fail("radius", std::to_string(radius_m), "a length in (0, 1000] m");
  if (elevations_deg.empty()) fail("elevations", "none", "at least one angle");
  for (const double elevation : elevations_deg)
    if (!(elevation > 0 && elevation <= 90))
      fail("elevations", std::to_string(elevation), "angles in (0, 90] degrees");
  if (count < int(elevations_deg.size()) || count > 10000)
    fail("count", std::to_string(count), "at least one view an elevation, at most 10000");
}

std::vector<Se3> hemisphere_views(const HemisphereOptions& options) {
  options.validate();
  const std::vector<int> share = share_among_rings(options);
  std::vector<Se3> views;
  for (std::size_t ring = 0; ring < share.size(); ++ring) {
    const double elevation = options.elevations_deg[ring] * RADIANS;
    for (int i = 0; i < share[ring]; ++i) {
      const double azimuth = 2 * std::numbers::pi * (i + (ring % 2 ? 0.5 : 0.0)) / share[ring];
      const Eigen::Vector3d direction(std::cos(elevation) * std::cos(azimuth),
                                      std::cos(elevation) * std::sin(azimuth), std::sin(elevation));
      views.push_back(look_at(options.center_m + options.radius_m * direction, options.center_m));
    }
  }
  validate_views(views, "options");
  return views;
}

std::optional<Eigen::Vector3d> looked_at_m(std::span<const Se3> camera_from_world) {
  Eigen::Matrix3d a = Eigen::Matrix3d::Zero();
  Eigen::Vector3d b = Eigen::Vector3d::Zero();
  for (const Se3& pose : camera_from_world) {
    const Se3 world_from_camera = inverse(pose);
    const Eigen::Vector3d axis = world_from_camera.rotation * Eigen::Vector3d::UnitZ();
    const Eigen::Matrix3d across = Eigen::Matrix3d::Identity() - axis * axis.transpose();
    a += across;
    b += across * world_from_camera.translation_m;
  }
  // The smallest eigenvalue is the mean squared sine of the angle between the axes and their common
  // direction.
  constexpr double MIN_SPREAD = 0.003, MIN_DEPTH_M = 0.01;
  const auto count = double(camera_from_world.size());
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> spread(a / count, Eigen::EigenvaluesOnly);
  if (!(spread.eigenvalues()[0] >= MIN_SPREAD)) return std::nullopt;
  const Eigen::Vector3d point_m = a.ldlt().solve(b);
  const auto in_front = std::ranges::count_if(
      camera_from_world, [&](const Se3& pose) { return (pose * point_m).z() > MIN_DEPTH_M; });
  if (2 * double(in_front) <= count) return std::nullopt;
  return point_m;
}

std::vector<Eigen::Vector3d> directions_to(std::span<const Se3> camera_from_world,
                                           const Eigen::Vector3d& center_m) {
  std::vector<Eigen::Vector3d> directions;
  for (const Se3& camera : camera_from_world)
    directions.push_back((inverse(camera).translation_m - center_m).normalized());
  return directions;
}

std::optional<Eigen::Vector3d> direction_above(std::span<const Eigen::Vector3d> directions) {
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (const Eigen::Vector3d& direction : directions) sum += direction;
  if (sum.norm() < 0.1 * double(directions.size())) return {};
  return sum.normalized();
}

void validate_views(std::span<const Se3> camera_from_world, const std::string& source) {
  if (camera_from_world.empty()) throw InputError(source, "views", "none", "at least one");
  for (std::size_t i = 0; i < camera_from_world.size(); ++i) {
    const Se3& view = camera_from_world[i];
    const std::string field = fmt::format("/{}/camera_from_world", i);
    require_rigid(view, source, field);
    for (std::size_t j = 0; j < i; ++j)
      if (is_same_view(view, camera_from_world[j]))
        throw InputError(source, field, "the same pose as view " + std::to_string(j),
                         "views that differ");
  }
}

void save_views(std::span<const Se3> camera_from_world, const std::filesystem::path& file) {
  nlohmann::json list = nlohmann::json::array();
  for (const Se3& view : camera_from_world)
    list.push_back({{"camera_from_world",
                     {{"R", rotation_numbers(view)}, {"t", translation_numbers(view, 1.0)}}}});
  write_file_atomically(file, list.dump(1) + "\n");
}

std::vector<Se3> load_views(const std::filesystem::path& file) {
  const nlohmann::json content = read_json(file);
  std::vector<Se3> views;
  ProjectedRotations projected;
  for (const JsonField& entry : JsonField{content, file.string(), ""}.elements()) {
    const JsonField pose = entry.at("camera_from_world");
    views.push_back(pose_from(pose.at("R"), pose.at("t"), 1.0, projected));
  }
  warn_of_projected(projected, file.string());
  validate_views(views, file.string());
  return views;
}

}  // namespace edgescout
