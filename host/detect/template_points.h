// The points of an object's templates as several views see them: looked up where visible_in_views
// draws.
#pragma once

#include "host/detect/nearest_viewpoint.h"
#include "host/register/register_points.h"

namespace edgescout {

// Of poses of the set's object: the points of the viewpoint nearest to each view's, at most `most`,
// evenly thinned, without those that the view's occluders hide. They may project outside its image:
// those count as far from every edge, or poses that reach over the border would have less to fit.
// The set, the views and the backend must outlive what is returned.
PointsInViews template_points(const TemplateSet& set, std::span<const RegisterView> views, int most,
                              Backend& backend);

}  // namespace edgescout
