#include "host/detect/template_projection.h"

#include "host/core/thinned.h"
#include "kernels/error.h"

namespace edgescout {

ThinnedView::ThinnedView(const TemplateView& view, int most) : points_(thinned(view.points, most)) {
  check(most >= 1 && most <= int(TEMPLATE_SCORE_MAX_POINTS), "ThinnedView: number of points");
}

bool ThinnedView::project(const Pose& camera_from_object, const TemplateProjectOptions& options,
                          TemplatePoint* out) const {
  const TemplateProjectJob job{camera_from_object, 0, points_.count(), 0, 0, 0};
  return project_template(points_, job, options, out) == 0;
}

}  // namespace edgescout
