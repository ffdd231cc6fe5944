// Looks up the points of an object that several views see, in its templates.
//
// It is cheaper than visible_in_views, which draws a depth map per pose and view.
#pragma once

#include "host/model/template_set.h"
#include "host/register/d2co.h"

namespace edgescout {

struct WantedPoints {
  int edges = 0, surface = 0;  // at most of a pose in a view, evenly thinned; 0: all
  bool in_image = false;       // only edges that project into the image
};

struct TemplatePoints {
  VisiblePoints visible;
  // By pair of a pose and a view: how many of the edges do not project into the image. All 0 where
  // WantedPoints::in_image leaves them out.
  Grid<std::size_t> outside;
};

// Of poses of the set's object. Edges are the points of the viewpoint nearest to each view's,
// without those that the view's occluders hide. Pairs of a pose and a view without occluders share
// them. Registration wants those in the image (points_in_image.h). Support wants all: points
// outside count as far from every edge; otherwise poses beyond the border would have less to
// explain. Views with depth also get samples of the whole surface, of which the far ones do not
// count: they face away.
TemplatePoints template_points(const TemplateSet& set, std::span<const ObjectView> views,
                               std::span<const ObjectPose> poses, const WantedPoints& wanted,
                               Backend& backend);

}  // namespace edgescout
