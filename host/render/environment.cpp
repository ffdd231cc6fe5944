#include "host/render/environment.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "host/render/photographs.h"

namespace edgescout {
namespace {

constexpr int SIDE_PX = 512;
// The disc of radius 1 has the area pi, the hemisphere 2 pi.
constexpr double PIXEL_STERADIANS = 2 * (2.0 / SIDE_PX) * (2.0 / SIDE_PX);

// The point of the unit disc that stands for a direction.
Eigen::Vector2d on_disc(const Eigen::Vector3d& direction) {
  const double z = std::max(0.0, direction.z());
  const Eigen::Vector2d p = direction.head<2>() / std::sqrt(1 + z);
  return direction.z() < 0 ? p.normalized() : p;
}

// Outside of the disc: the direction on the horizon.
Eigen::Vector3d direction_at(Eigen::Vector2d p) {
  if (p.squaredNorm() > 1) p.normalize();
  const double z = 1 - p.squaredNorm();
  const Eigen::Vector2d level = p * std::sqrt(1 + z);
  return {level.x(), level.y(), z};
}

Eigen::Vector2d disc_point(int x, int y) {
  return {2 * (x + 0.5) / SIDE_PX - 1, 2 * (y + 0.5) / SIDE_PX - 1};
}

}  // namespace

FarLight photograph_overhead(Image photograph) {
  return [photograph = std::move(photograph)](const Eigen::Vector3d& direction) {
    const Eigen::Vector2d p = 0.5 * (on_disc(direction) + Eigen::Vector2d(1, 1));
    const int x = std::clamp(static_cast<int>(p.x() * photograph.width), 0, photograph.width - 1),
              y = std::clamp(static_cast<int>(p.y() * photograph.height), 0, photograph.height - 1);
    // What the photograph shows as white was brighter than white.
    const double light = light_of_grey(photograph.at(x, y));
    return light + 6 * std::pow(light, 8);
  };
}

Environment::Environment(const FarLight& far_light, double irradiance,
                         std::span<const FarLamp> lamps) {
  Level finest{SIDE_PX, {}};
  for (int y = 0; y < SIDE_PX; ++y)
    for (int x = 0; x < SIDE_PX; ++x)
      finest.light.push_back(static_cast<float>(far_light(direction_at(disc_point(x, y)))));
  levels_.push_back(std::move(finest));
  const double unscaled = sum_irradiance();
  for (float& light : levels_[0].light)
    light *= static_cast<float>(unscaled > 0 ? irradiance / unscaled : 0);
  for (const FarLamp& lamp : lamps) add(lamp);
  irradiance_ = sum_irradiance();
  while (levels_.back().side_px > 2) {
    const Level& fine = levels_.back();
    Level coarse{fine.side_px / 2, {}};
    for (int y = 0; y < fine.side_px; y += 2)
      for (int x = 0; x < fine.side_px; x += 2) {
        const float* at = &fine.light[static_cast<std::size_t>(y) * fine.side_px + x];
        coarse.light.push_back((at[0] + at[1] + at[fine.side_px] + at[fine.side_px + 1]) / 4);
      }
    levels_.push_back(std::move(coarse));
  }
}

void Environment::add(const FarLamp& lamp) {
  std::vector<std::size_t> covered;
  std::size_t nearest = 0;
  double nearest_cosine = -1;
  for (int y = 0; y < SIDE_PX; ++y)
    for (int x = 0; x < SIDE_PX; ++x) {
      const Eigen::Vector2d p = disc_point(x, y);
      if (p.squaredNorm() > 1) continue;
      const double cosine = direction_at(p).dot(lamp.direction);
      const std::size_t i = static_cast<std::size_t>(y) * SIDE_PX + x;
      if (cosine > std::cos(lamp.half_angle_rad)) covered.push_back(i);
      if (cosine > nearest_cosine) {
        nearest_cosine = cosine;
        nearest = i;
      }
    }
  if (covered.empty()) covered.push_back(nearest);
  const double solid_angle = static_cast<double>(covered.size()) * PIXEL_STERADIANS;
  for (const std::size_t i : covered)
    levels_[0].light[i] += static_cast<float>(lamp.irradiance * std::numbers::pi / solid_angle);
}

double Environment::Level::at(double x, double y) const {
  const double u = std::clamp(x * side_px - 0.5, 0.0, side_px - 1.001),
               v = std::clamp(y * side_px - 0.5, 0.0, side_px - 1.001);
  const int column = static_cast<int>(u), row = static_cast<int>(v);
  const double fu = u - column, fv = v - row;
  const float* top = &light[static_cast<std::size_t>(row) * side_px + column];
  const float* bottom = top + side_px;
  return (1 - fv) * ((1 - fu) * top[0] + fu * top[1]) +
         fv * ((1 - fu) * bottom[0] + fu * bottom[1]);
}

double Environment::light(const Eigen::Vector3d& direction, double solid_angle) const {
  const Eigen::Vector2d p = 0.5 * (on_disc(direction) + Eigen::Vector2d(1, 1));
  const double level = std::clamp(0.5 * std::log2(solid_angle / PIXEL_STERADIANS), 0.0,
                                  static_cast<double>(levels_.size()) - 1);
  const auto finer = static_cast<std::size_t>(level);
  const double share = level - static_cast<double>(finer);
  const double fine = levels_[finer].at(p.x(), p.y());
  if (share == 0) return fine;
  return (1 - share) * fine + share * levels_[finer + 1].at(p.x(), p.y());
}

double Environment::sum_irradiance() const {
  double sum = 0;
  for (int y = 0; y < SIDE_PX; ++y)
    for (int x = 0; x < SIDE_PX; ++x) {
      const double cosine = 1 - disc_point(x, y).squaredNorm();
      if (cosine > 0) sum += cosine * levels_[0].light[static_cast<std::size_t>(y) * SIDE_PX + x];
    }
  return sum * PIXEL_STERADIANS / std::numbers::pi;
}

}  // namespace edgescout
