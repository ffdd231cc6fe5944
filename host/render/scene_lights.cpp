#include "host/render/scene_lights.h"

#include <array>
#include <cmath>
#include <numbers>

#include "host/render/photographs.h"
#include "host/render/room.h"
#include "host/render/scene_geometry.h"

namespace edgescout {
namespace {

constexpr int SKY_LIGHTS = 40;

struct Lamp {
  Eigen::Vector3d centre_m;
  double radius_m = 0;
  double irradiance = 0;
};

Lamp random_lamp(double irradiance, double reach, Random& random) {
  const double distance = reach * random.uniform(4, 9);
  const double elevation = random.uniform(0.6, 1.35);
  const Eigen::Vector3d centre =
      distance * on_sphere(random.uniform(0, 2 * std::numbers::pi), elevation);
  return {centre, distance * random.uniform(0.03, 0.15), irradiance};
}

// A cluster of points, which makes the border of its shadows soft. A wide lamp needs more of them,
// and its shadows are coarse.
void add_points(SimulatedScene& scene, const Lamp& lamp, Random& random) {
  const bool wide = lamp.radius_m > 0.16 * lamp.centre_m.norm();
  const int points = wide ? 24 : 8, shadow_px = wide ? 320 : 640;
  for (int i = 0; i < points; ++i)
    scene.lights.push_back(
        {lamp.centre_m + lamp.radius_m * random.direction(), lamp.irradiance / points, shadow_px});
}

FarLamp far_lamp(const Lamp& lamp) {
  const double distance = lamp.centre_m.norm();
  return {lamp.centre_m / distance, std::asin(std::min(1.0, lamp.radius_m / distance)),
          lamp.irradiance};
}

// Directions of equal areas of the upper hemisphere. Their mean cosine on the board is a half.
Eigen::Vector3d sky_direction(int i) {
  const double elevation = std::asin((i + 0.5) / SKY_LIGHTS);
  return on_sphere(i * std::numbers::pi * (3 - std::sqrt(5.0)), elevation);
}

void add_even_sky(SimulatedScene& scene, double irradiance, double reach) {
  for (int i = 0; i < SKY_LIGHTS; ++i)
    scene.lights.push_back({20 * reach * sky_direction(i), 2 * irradiance / SKY_LIGHTS, 224, true});
}

void add_environment(SimulatedScene& scene, const FarLight& far_light, double irradiance,
                     std::span<const FarLamp> lamps) {
  scene.environment =
      std::make_shared<Environment>(far_light, irradiance, std::span<const FarLamp>());
  scene.environment_with_lamps = std::make_shared<Environment>(far_light, irradiance, lamps);
  const double reach = reach_m(scene), steradians = 2 * std::numbers::pi / SKY_LIGHTS;
  for (int i = 0; i < SKY_LIGHTS; ++i) {
    const double light = scene.environment->light(sky_direction(i), steradians);
    scene.lights.push_back({20 * reach * sky_direction(i), 2 * light / SKY_LIGHTS, 224, true});
  }
}

FarLight random_surroundings(const PhotographFolders& photographs, const Random& random) {
  constexpr int PHOTOGRAPH_PX = 512;
  if (photographs.empty()) return random_room(random);
  return photograph_overhead(random_crop(photographs, PHOTOGRAPH_PX, PHOTOGRAPH_PX, random));
}

}  // namespace

void add_lights(SimulatedScene& scene, const PhotographFolders& photographs, const Random& random) {
  const LightRanges& ranges = scene.options.light;
  const double reach = reach_m(scene);
  Random stream = random.split("lights");
  Random widths = random.split("lamp width"), shares = random.split("lamp share");
  const double exposure = stream.uniform(0.75, 1.3);
  double lamps = exposure * stream.uniform(0.4, 0.75);
  const double first_share = stream.uniform(0.55, 0.85);
  if (ranges.lamp_share.high > 0) lamps = exposure * draw(ranges.lamp_share, shares);
  std::vector<FarLamp> far_lamps;
  for (const double irradiance : {lamps * first_share, lamps * (1 - first_share)}) {
    Lamp lamp = random_lamp(irradiance, reach, stream);
    if (ranges.lamp_width.high > 0)
      lamp.radius_m = lamp.centre_m.norm() * draw(ranges.lamp_width, widths);
    add_points(scene, lamp, stream);
    far_lamps.push_back(far_lamp(lamp));
  }
  const double rest = exposure - lamps;
  if (scene.options.surfaces.reflect())
    add_environment(scene, random_surroundings(photographs, random.split("surroundings")), rest,
                    far_lamps);
  else
    add_even_sky(scene, rest, reach);
  scene.ambient = 0.06 * exposure;
}

}  // namespace edgescout
