// Whether the grey values inside a pose's silhouette follow from its surface.
//
// A matte object of one material under distant light shows one grey wherever its surface faces one
// way: irradiance is a smooth function of the normal, well described by nine spherical harmonics
// (Ramamoorthi and Hanrahan 2001; Basri and Jacobs 2003). A right pose therefore leaves little grey
// unexplained; a wrong one covers background, neighbours and faces it does not know of.
#pragma once

#include <span>
#include <vector>

#include "host/register/d2co.h"

namespace edgescout {

struct Shading {
  double pixels = 0;       // compared: inside the image and away from edges of the depth map
  double squares = 0;      // sum of squared deviations of their grey values from the mean
  double unexplained = 0;  // the same from the best function of the normal
};

// Another view of the same pose beside the first.
void add(Shading& sum, const Shading& other);

// Root mean square of what is unexplained over that of all deviations, in [0, 1]; 1 where too
// little was compared to tell. Contrast as weak as the image's noise explains nothing, either.
double unexplained_grey(const Shading& shading);

// One a pose and view, poses outermost (poses.size() * views.size()). Views without an image:
// nothing compared.
std::vector<Shading> shading(std::span<const EdgeModel> models, std::span<const ObjectPose> poses,
                             std::span<const RegisterView> views, Backend& backend);

}  // namespace edgescout
