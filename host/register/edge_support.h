// How well an image's edges support poses, against chance at the same place.
//
// The kernel (kernels/edge_support.h) compares points with displaced copies of themselves. Here
// visible edges become its points: each stands for as many independent observations as its length
// in the image. Edges that lie side by side are found or missed together, so points of one cell and
// orientation count no more than one edge. Without that, parts with dense edges are believed
// anywhere.
#pragma once

#include <span>

#include "host/register/scene.h"
#include "host/register/visible_in_views.h"

namespace edgescout {

// The edges that a pose shows in a view.
struct ShownEdges {
  std::span<const ModelPoint> points;
  std::span<const std::uint8_t> on_silhouette;  // SilhouetteMarks; without them all are interior
};

// Rows are poses, columns views. All zero where the view has no image.
Grid<EdgeSupport> edge_support(const Scene& scene, std::span<const ObjectPose> poses,
                               const Grid<ShownEdges>& shown);
// `visible` is that of the poses, with marks (marked_in_views).
Grid<EdgeSupport> edge_support(const Scene& scene, std::span<const ObjectPose> poses,
                               const Grid<VisibleInView>& visible);

}  // namespace edgescout
