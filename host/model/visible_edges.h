// Finds the edge points of a model that a camera sees: the paper's raster template (Sec. 3.1, Fig.
// 1e).
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "host/core/kernel_types.h"
#include "host/model/edge_model.h"
#include "kernels/backend.h"

namespace edgescout {

// A depth map of the whole mesh from the same place (kernel depth_raster) removes hidden points. It
// is a square of `depth_map_size_px`, framed on the object. A point is hidden if all 3 x 3 pixels
// around it lie nearer by more than the tolerance. So points on the contour, which border the
// background, are never lost. In return hidden edges within one map pixel of a contour count as
// visible.
struct VisibilityOptions {
  int depth_map_size_px = 200;
  double tolerance = 0.01;  // of the object's diameter
  void validate() const;    // InputError naming the field and the violated bound
};

// By point: 1 where one of the 3 x 3 pixels around it shows the background, else 0.
using SilhouetteMarks = std::vector<std::uint8_t>;

using VisibleSurfaces = std::vector<std::vector<SurfacePoint>>;  // by pose

// Raster points in the object frame, one list per pose. The list is empty where the object is not
// in front of the camera. `marks`, where given, receives the marks of each list; `surfaces` the
// samples of the surface that are visible and do not border the background. Samples that face away
// are among them where the object is thin.
std::vector<std::vector<ModelPoint>> visible_edges(const EdgeModel& model,
                                                   std::span<const Se3> camera_from_object,
                                                   Backend& backend,
                                                   const VisibilityOptions& options = {},
                                                   std::vector<SilhouetteMarks>* marks = nullptr,
                                                   VisibleSurfaces* surfaces = nullptr);

}  // namespace edgescout
