// Projects the points of a template into an image; the scan does it once per template and region.
#pragma once

#include "host/model/template_set.h"
#include "kernels/template_project.h"

namespace edgescout {

// The points of one viewpoint, evenly thinned, for the fast path of the kernel template_project.
class ThinnedView {
 public:
  // At most `most` points, 1 to TEMPLATE_SCORE_MAX_POINTS.
  ThinnedView(const TemplateView& view, int most);
  int count() const { return int(points_.count()); }

  // Writes count() points to `out`: rounded pixels relative to (x_px, y_px) and bins of the
  // orientation, `bins` of them over pi. Returns false where a point is nearer than `nearest_m`;
  // the values written then mean nothing.
  bool project(const Pose& camera_from_object, const Intrinsics& intrinsics, float x_px, float y_px,
               int bins, float nearest_m, TemplatePoint* out) const;
  // Depth of one of the points, along the optical axis.
  float depth_m(const Pose& camera_from_object, int point) const {
    const float* m = camera_from_object.m;
    return m[8] * points_.plane(0)[point] + m[9] * points_.plane(1)[point] +
           m[10] * points_.plane(2)[point] + m[11];
  }

 private:
  ModelPointPlanes points_;
};

}  // namespace edgescout
