#include "host/model/viewpoints.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "kernels/error.h"

namespace edgescout {

std::vector<Eigen::Vector3d> icosphere(int frequency) {
  check(frequency >= 1 && frequency <= 64, "icosphere: frequency in [1, 64]");
  const double phi = std::numbers::phi;
  const Eigen::Vector3d corners[12] = {{-1, phi, 0}, {1, phi, 0}, {-1, -phi, 0}, {1, -phi, 0},
                                       {0, -1, phi}, {0, 1, phi}, {0, -1, -phi}, {0, 1, -phi},
                                       {phi, 0, -1}, {phi, 0, 1}, {-phi, 0, -1}, {-phi, 0, 1}};
  const int faces[20][3] = {{0, 11, 5}, {0, 5, 1},  {0, 1, 7},   {0, 7, 10}, {0, 10, 11},
                            {1, 5, 9},  {5, 11, 4}, {11, 10, 2}, {10, 7, 6}, {7, 1, 8},
                            {3, 9, 4},  {3, 4, 2},  {3, 2, 6},   {3, 6, 8},  {3, 8, 9},
                            {4, 9, 5},  {2, 4, 11}, {6, 2, 10},  {8, 6, 7},  {9, 8, 1}};
  std::vector<Eigen::Vector3d> directions;
  const double same = 0.2 / frequency;
  for (const auto& face : faces)
    for (int i = 0; i <= frequency; ++i)
      for (int j = 0; i + j <= frequency; ++j) {
        const Eigen::Vector3d d =
            ((frequency - i - j) * corners[face[0]] + i * corners[face[1]] + j * corners[face[2]])
                .normalized();
        const bool inner = i > 0 && j > 0 && i + j < frequency;
        bool known = false;
        for (std::size_t k = 0; !inner && !known && k < directions.size(); ++k)
          known = (directions[k] - d).norm() < same;
        if (!known) directions.push_back(d);
      }
  return directions;
}

bool SphereRange::contains(const Eigen::Vector3d& direction) const {
  constexpr double degrees = 180 / std::numbers::pi, slack = 1e-9;
  const double latitude = std::asin(std::clamp(direction.z(), -1.0, 1.0)) * degrees;
  if (latitude < latitude_min_deg - slack || latitude > latitude_max_deg + slack) return false;
  if (longitude_max_deg - longitude_min_deg >= 360) return true;
  const double span = std::fmod(longitude_max_deg - longitude_min_deg + 720, 360);
  const double from_start =
      std::fmod(std::atan2(direction.y(), direction.x()) * degrees - longitude_min_deg + 720, 360);
  return from_start <= span + slack;
}

std::vector<Eigen::Vector3d> modulo_symmetry(const std::vector<Eigen::Vector3d>& directions,
                                             const Symmetries& symmetries, double margin_rad) {
  const Eigen::Vector3d generic = Eigen::Vector3d(0.3141, 0.5772, 0.7548).normalized();
  std::vector<Eigen::Vector3d> kept;
  for (const Eigen::Vector3d& d : directions) {
    bool canonical = true;
    for (const Se3& symmetry : symmetries.discrete) {
      // d may lie margin_rad beyond the plane midway between w and its image under the symmetry;
      // scaled by |S w - w|.
      const double margin = std::sin(margin_rad) * (symmetry.rotation * generic - generic).norm();
      canonical &= d.dot(generic) >= (symmetry.rotation * d).dot(generic) - margin;
    }
    if (canonical) kept.push_back(d);
  }
  return kept;
}

std::vector<Eigen::Vector3d> viewpoints_in(const SphereRange& range, const Symmetries& symmetries,
                                           int frequency) {
  std::vector<Eigen::Vector3d> wanted;
  for (const Eigen::Vector3d& d : icosphere(frequency))
    if (std::ranges::any_of(symmetries.discrete,
                            [&](const Se3& s) { return range.contains(s.rotation * d); }))
      wanted.push_back(d);
  return modulo_symmetry(wanted, symmetries, ICOSPHERE_GAP_RAD / frequency);
}

Eigen::Quaterniond looking_from(const Eigen::Vector3d& direction) {
  const Eigen::Vector3d z = -direction.normalized();
  const Eigen::Vector3d helper =
      std::abs(z.z()) < 0.9 ? Eigen::Vector3d::UnitZ() : Eigen::Vector3d::UnitX();
  const Eigen::Vector3d x = z.cross(helper).normalized(), y = z.cross(x);
  Eigen::Matrix3d object_from_camera;
  object_from_camera << x, y, z;
  return Eigen::Quaterniond(object_from_camera.transpose());
}

}  // namespace edgescout
