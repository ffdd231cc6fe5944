// Scores every template at every place of the image on the coarse tensor (paper, Sec. 3.4, Eq. 7).
#pragma once

#include <cmath>
#include <span>
#include <vector>

#include "host/core/time_limit.h"
#include "host/detect/world_prior.h"
#include "host/model/template_set.h"
#include "host/register/object_view.h"

namespace edgescout {

// A rectangle of an image, px, from (x, y) on. A width or height of 0 reaches to the image's
// border.
struct ImageRegion {
  double x = 0, y = 0, width = 0, height = 0;
};

struct ScanOptions {
  int points = 60;          // of each template, evenly thinned
  int quick_points = 16;    // of each template in the first pass, which all templates take
  int quick_kept = 8;       // templates that pass it in a region, for each hit that is kept there
  int anchor_step = 2;      // coarse px between anchors, the places that are tried
  int region_columns = 32;  // anchors that share one projection of a template
  int region_rows = 16;
  int num_kept = 40000;  // hits of a set of one scale (share_of_scale); every region keeps the same
                         // number, so that texture in one does not displace the hits of the others
  ImageRegion within;    // of the undistorted image: where the objects' centres are searched;
                         // registration may move a pose a pixel or two out of it
  WorldPrior world;      // poses outside are not searched; its frame is the views' world
};

// Factor of ScanHit::rank: the fourth root of the distance. The square root finds one more of 54
// rendered parts and loses four of 16 cats.
inline double scan_size_weight(double distance_m) { return std::sqrt(std::sqrt(distance_m)); }

// One template at its best place of a region.
struct ScanHit {
  ObjectPose pose;     // in the camera frame; its object is 0
  int viewpoint = 0;   // of the template set
  int scale = 0;       // of distance_scales
  double mean_px = 0;  // Eq. 7, coarse px; values are capped at 4, and 3.25 outside the image
  double rank = 0;     // mean_px times scan_size_weight; lower is better
};

// Pose camera_from_object of a template that is turned by `in_plane_rad` about its line of sight.
// Its centre is seen at `pixel`, `distance_m` away along the ray.
Se3 place_template(const TemplateSet& set, const TemplateView& view, double in_plane_rad,
                   double distance_m, const Eigen::Vector2d& pixel, const Camera& camera);

// The level of a view that suits a scale of the set's distances.
std::size_t level_of_scale(const TemplateSet& set, int scale, const ObjectView& view);

// How many hits or poses each scale of a set gets, where a set of one scale gets `of_one`. Four
// scales get twice as many together: enough that few are lost, at twice the time of their
// alignment.
inline std::size_t share_of_scale(std::size_t of_one, const TemplateSet& set) {
  const double scales = double(distance_scales(set.options).size());
  return std::size_t(std::ceil(double(of_one) / std::sqrt(scales)));
}

// The best hits of every scale and region of the image, best first within a region.
//
// Templates stand some 0.2 rad apart, so the best template is off by an angle. The nearer and
// larger the object is, the more pixels that makes. Ranked by the mean alone, small templates on
// clutter win over large ones on their object. Ranked by the mean times the distance, it is the
// other way round. `rank` lies between the two.
//
// A first pass compares few points of all templates, a second all points of the best of them.
//
// Ranks of several scales do not compare: each has its own tensor. What is left after alignment
// does (template_support.h).
//
// In each region, templates are projected exactly at the region's middle and then shifted, so that
// perspective changes across the image. Anchors and templates whose poses options.world excludes
// are left out, but for those beside the prior that stand for poses inside; regions without any
// give no hits. Neither do regions that are not yet scanned where the limit is over. InputError:
// options.within lies outside the image.
std::vector<ScanHit> coarse_scan(const TemplateSet& set, const ObjectView& view, Backend& backend,
                                 const ScanOptions& options, const TimeLimit* limit = nullptr);

// The mean_px that a hit at exactly this pose would have on the level that suits its size; 4, the
// cap, where the object shows no edges. Templates stand beside the poses between them, so the best
// hit of an object is worse.
double scan_mean_px(const TemplateSet& set, const ObjectView& view, const Se3& camera_from_object,
                    Backend& backend, const ScanOptions& options);

}  // namespace edgescout
