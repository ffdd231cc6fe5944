// Looks up the points of an object that several views see, in its templates.
//
// It is cheaper than visible_in_views, which draws a depth map per pose and view.
#pragma once

#include "host/model/viewpoint_index.h"
#include "host/register/d2co.h"

namespace edgescout {

// Returns a function of poses of the set's object. It gives the points of the viewpoint nearest to
// each view's, at most `most`, evenly thinned, without those that the view's occluders hide. Points
// may project outside the image: they count as far from every edge. Otherwise poses that reach over
// the border would have less to fit. Views with depth also get samples of the whole surface, of
// which the far ones do not count: they face away. The set, the views and the backend must outlive
// the function.
PointsInViews template_points(const TemplateSet& set, std::span<const ObjectView> views, int most,
                              Backend& backend);

}  // namespace edgescout
