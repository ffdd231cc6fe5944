// Whether the grey values inside a pose's silhouette follow from its surface.
//
// On a matte object of one material under distant light, surfaces of one direction have one grey
// value: irradiance is a smooth function of the normal, well described by nine spherical harmonics
// (Ramamoorthi and Hanrahan 2001; Basri and Jacobs 2003). A right pose therefore leaves little grey
// unexplained. A wrong pose covers background, neighbours and other faces.
#pragma once

#include <span>

#include "host/core/grid.h"
#include "host/register/pose_estimate.h"
#include "host/register/scene.h"

namespace edgescout {

// Rows are poses, columns views. All zero where the view or its tensor has no image.
Grid<Shading> shading(const Scene& scene, std::span<const ObjectPose> poses);

}  // namespace edgescout
