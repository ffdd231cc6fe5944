// The edge points of objects that each of several views sees.
#pragma once

#include <algorithm>
#include <span>
#include <vector>

#include "host/core/grid.h"
#include "host/model/visible_edges.h"
#include "host/register/points_in_views.h"
#include "host/register/scene.h"

namespace edgescout {

struct VisibleInView {
  std::vector<ModelPoint> points;  // neither the object itself nor the view's occluders hide them
  SilhouetteMarks on_silhouette;   // of the points; empty where no marks were asked for
  std::size_t unoccluded = 0;      // how many there would be without occluders
  // Samples of the surface that the object itself does not hide; empty where the view has no depth.
  std::vector<SurfacePoint> surface;
};

// Rows are poses, columns views. Points project inside the image or not.
Grid<VisibleInView> visible_in_views(const Scene& scene, std::span<const ObjectPose> poses,
                                     const VisibilityOptions& visibility = {});

// The same with marks.
Grid<VisibleInView> marked_in_views(const Scene& scene, std::span<const ObjectPose> poses,
                                    const VisibilityOptions& visibility = {});

// One of the lists of all pairs: at most `most` points of each, evenly thinned; 0: all.
template <typename T>
PointsInViews<T> points_of(const Grid<VisibleInView>& visible, std::vector<T> VisibleInView::*list,
                           int most, ThreadPool& threads) {
  PointsInViews<T> in_views{{}, Grid<PointRange>(visible.rows(), visible.columns())};
  JoinedLists<T> joined = join_lists(
      visible.values().size(),
      [&](std::size_t i) -> const std::vector<T>& { return visible.values()[i].*list; }, most,
      threads);
  in_views.points = std::move(joined.values);
  std::ranges::copy(joined.ranges, in_views.ranges.values().begin());
  return in_views;
}

// The edge points alone.
Grid<std::vector<ModelPoint>> visible_points(const Scene& scene, std::span<const ObjectPose> poses,
                                             const VisibilityOptions& visibility = {});

}  // namespace edgescout
