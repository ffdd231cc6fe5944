// The light that comes from far away over the table: what metal and gloss reflect.
#pragma once

#include <functional>
#include <span>
#include <vector>

#include "host/core/types.h"

namespace edgescout {

// Light from a direction with z >= 0 in the world frame. A mirror is white at 1.
using FarLight = std::function<double(const Eigen::Vector3d& direction)>;

// A photograph as if it were bent over the table. Its brightest parts are lamps.
FarLight photograph_overhead(Image photograph);

// A far lamp: a disc of even light.
struct FarLamp {
  Eigen::Vector3d direction;  // unit, towards it
  double half_angle_rad = 0;
  double irradiance = 0;  // on a surface that faces it; 1 makes a white surface white
};

// Far light as an image that can be read at any sharpness.
//
// The image is Lambert's azimuthal projection of the directions with z >= 0. It keeps areas: every
// pixel has the same solid angle. A pyramid of halved images holds means over larger solid angles.
class Environment {
 public:
  // The far light is scaled to this irradiance on the table. Then the lamps are added.
  Environment(const FarLight& far_light, double irradiance, std::span<const FarLamp> lamps);

  // Mean light of a cone of about this solid angle. A direction below the horizon counts as on it.
  double light(const Eigen::Vector3d& direction, double solid_angle) const;
  // Irradiance on the table, lamps included.
  double irradiance() const { return irradiance_; }

 private:
  struct Level {
    int side_px = 0;
    std::vector<float> light;
    double at(double x, double y) const;  // bilinear; x and y from 0 to 1 over the image
  };
  void add(const FarLamp& lamp);
  double sum_irradiance() const;
  std::vector<Level> levels_;  // the finest first
  double irradiance_ = 0;
};

}  // namespace edgescout
