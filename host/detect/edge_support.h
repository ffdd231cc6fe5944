// Counts how many points of a pose the edges of an image support, beside copies of the pose.
//
// Public header.
#pragma once

#include "host/detect/edge_claims.h"

namespace edgescout {

// Numbers of model points.
struct SupportedPoints {
  double visible = 0;                // that the pose shows, inside the image or not
  double in_image = 0;               // of these: inside the image
  std::size_t supported = 0;         // that have an image edge near (supported_points)
  std::size_t supported_beside = 0;  // the same of the best copy
  // Whether the image tells the pose from its surroundings.
  bool exceeds_copies() const { return supported > supported_beside; }
};

// In the first view. The 16 copies are moved across the line of sight by 7 and 14 px.
SupportedPoints count_supported(const Scene& scene, const ObjectPose& pose,
                         const EdgeClaimOptions& options = {});

}  // namespace edgescout
