// Sizes and directions that the makers of a scene share.
#pragma once

#include "host/core/random.h"
#include "host/render/scene.h"

namespace edgescout {

// The middle of the mesh's box in its own frame; exactly zero if it is the origin up to rounding.
Eigen::Vector3d middle_m(const Mesh& mesh);

// Radius about the world's z axis that contains the middles of all targets and half their size.
double reach_m(const SimulatedScene& scene);

// One of the targets, each as likely. The scene must have one.
const PlacedObject& random_target(const SimulatedScene& scene, Random& random);

double mean_diameter_m(std::span<const Object> objects);

// Unit vector. The elevation is over the plane z = 0.
Eigen::Vector3d on_sphere(double azimuth_rad, double elevation_rad);

}  // namespace edgescout
