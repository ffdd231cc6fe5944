// Every template at every place of the image, on the coarse tensor (paper, Sec. 3.4, Eq. 7).
#pragma once

#include <cmath>
#include <span>
#include <vector>

#include "host/detect/observation.h"
#include "host/model/template_set.h"

namespace edgescout {

// Part of an image, px: pixels from (x, y) on. A width or height of 0 reaches to the image's
// border.
struct ImageRegion {
  double x = 0, y = 0, width = 0, height = 0;
};

struct ScanOptions {
  int points = 60;          // of each template, evenly thinned
  int anchor_step = 2;      // coarse pixels between places
  int region_columns = 32;  // anchors for which one projection of a template holds
  int region_rows = 16;
  // hits, shared evenly among the regions: texture must not crowd out the rest of the image
  int num_kept = 10000;
  ImageRegion within;  // of the undistorted image: where objects' centres are looked for; from
                       // there registration may lead a pixel or two out of it
};

// Of ScanHit::rank: the fourth root; the square root finds one more of 54 rendered parts and loses
// four of 16 cats.
inline double scan_size_weight(double distance_m) { return std::sqrt(std::sqrt(distance_m)); }

// One template at one place.
struct ScanHit {
  int view = 0;  // of the template set
  Se3 camera_from_object;
  double mean_px = 0;  // Eq. 7, in coarse pixels, values capped at 4, those outside the image 3.25
  double rank = 0;     // mean_px times the fourth root of the distance in metres; lower is better
};

// Pose of a template turned by `in_plane_rad` about its line of sight whose centre is seen at
// `pixel`, `distance_m` away along the ray.
Se3 place_template(const TemplateSet& set, const TemplateView& view, double in_plane_rad,
                   double distance_m, const Eigen::Vector2d& pixel, const Camera& camera);

// The best hits of every region of the image, best first within a region. Templates stand some 0.2
// rad apart, so the best of them lies off by an angle: by the more pixels, the nearer and larger
// the object. Ranked by the mean alone, small templates on clutter win over large ones on their
// object; multiplied with the distance itself it is the other way round. `rank` lies between. In
// each region templates are projected exactly at its middle and then shifted: perspective across
// the image is respected. InputError where options.within lies beside the image.
std::vector<ScanHit> coarse_scan(const TemplateSet& set, const Observation& observation,
                                 Backend& backend, const ScanOptions& options);

// Observation::hits of these objects, unless they are there.
void scan_for(std::span<const TemplateSet> sets, Observation& observation, Backend& backend,
              const ScanOptions& options);

}  // namespace edgescout
