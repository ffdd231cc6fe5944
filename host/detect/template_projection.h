// Projects the points of a template into an image; the scan does it once per template and region.
#pragma once

#include "host/model/template_set.h"
#include "kernels/template_project.h"

namespace edgescout {

// Points nearer to the camera are not drawn.
inline float nearest_drawn_m(const TemplateSet& set) { return float(0.1 * set.model.radius_m); }

// The points of one viewpoint, evenly thinned, for the fast path of the kernel template_project.
class ThinnedView {
 public:
  // At most `most` points, 1 to TEMPLATE_SCORE_MAX_POINTS.
  ThinnedView(const TemplateView& view, int most);
  int count() const { return int(points_.count()); }

  // Writes count() points to `out`: rounded pixels of the image and bins of the orientation.
  // Returns false where a point is too near; the values written then mean nothing.
  bool project(const Pose& camera_from_object, const TemplateProjectOptions& options,
               TemplatePoint* out) const;
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
