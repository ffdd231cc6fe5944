#include "host/detect/detect_options.h"

namespace edgescout {

RefineOptions DetectOptions::refine_defaults() {
  RefineOptions options;
  options.search.rotation_rad = 0.25;  // templates stand some 0.2 rad apart
  return options;
}

void describe_hits(DetectOptions& o, OptionVisitor& visit) {
  visit.number({"scan-hits",
                "Number of the scan's best hits that are kept for each object and image. Other "
                "images of the scene rescore all of them"},
               o.scan.num_kept, 1, 10000000);
  visit.number({"coarse-poses",
                "Number of the best hits that enter the coarse stage: registration on the coarse "
                "tensor"},
               o.coarse_poses, 1, 1000000);
  visit.number({"medium-poses",
                "Number of the coarse poses with the most edge support that enter the medium "
                "stage: registration in full resolution"},
               o.medium_poses, 1, 1000000);
  visit.number({"coarse-poses-joint",
                "Number of the best hits that enter the coarse stage where other images support "
                "the search, in place of --coarse-poses"},
               o.coarse_poses_joint, 1, 1000000);
  visit.number({"medium-poses-joint",
                "Number of these that enter the medium stage, in place of --medium-poses"},
               o.medium_poses_joint, 1, 1000000);
}

void describe_search(DetectOptions& o, OptionVisitor& visit) {
  visit.group("Detection");
  visit.number({"template-points", "Number of edge points of each template that the scan compares"},
               o.scan.points, 4, int(TEMPLATE_SCORE_MAX_POINTS));
  visit.number(
      {"anchor-step",
       "Distance between the image positions that the scan tries, px of the coarse tensor"},
      o.scan.anchor_step, 1, 16);
  describe_hits(o, visit);
  visit.number({"support-views",
                "Largest number of other images of the scene that support the search of one image"},
               o.support_views, 1, 10000);
  visit.number({"candidates",
                "Number of poses of each object and image that enter the fine stage: the full "
                "registration"},
               o.candidates, 1, 100000);
}

namespace {

void describe_region(ImageRegion& region, OptionVisitor& visit) {
  visit.number({"region-x",
                "Left border of the region in which objects' centres are searched, px of the "
                "undistorted image",
                OptionLevel::Basic},
               region.x, 0.0, 1e6);
  visit.number({"region-y",
                "Upper border of the region in which objects' centres are searched, px of the "
                "undistorted image",
                OptionLevel::Basic},
               region.y, 0.0, 1e6);
  visit.number({"region-width",
                "Width of the region in which objects' centres are searched, px. 0: to the image's "
                "border",
                OptionLevel::Basic},
               region.width, 0.0, 1e6);
  visit.number({"region-height",
                "Height of the region in which objects' centres are searched, px. 0: to the "
                "image's border",
                OptionLevel::Basic},
               region.height, 0.0, 1e6);
}

}  // namespace

void describe(DetectOptions& o, OptionVisitor& visit) {
  describe_search(o, visit);
  visit.number({"enlarge-below",
                "Images in which an object spans fewer pixels, in the middle of its distances, are "
                "enlarged twice before the search. 0: never"},
               o.enlarge_below_px, 0.0, 1e6);
  visit.number(
      {"min-probability", "Poses of a lower probability are not reported", OptionLevel::Basic},
      o.min_probability, 0.0, 1.0);
  describe_region(o.scan.within, visit);
  visit.number({"restart-rotation",
                "Angle by which turned starts around the selected poses are rotated, rad. 0: no "
                "restart"},
               o.restart_rotation_rad, 0.0, 1.0);
  visit.number({"max-detections", "Largest number of poses that are reported for an image",
                OptionLevel::Basic},
               o.max_detections, 1, 100000);
  visit.number({"penetration",
                "Largest depth to which parts may overlap, m. Of two poses from several images "
                "that overlap further, the less probable one loses probability"},
               o.penetration_m, 0.0, 1.0);
}

void DetectOptions::validate() const {
  check_bounds(*this, "detect");
  scan.world.validate();
  const BoundsCheck in("detect");
  in.require("region_columns", scan.region_columns, 1, 4096);
  in.require("region_rows", scan.region_rows, 1, 4096);
  in.require("region_columns * region_rows", double(scan.region_columns) * scan.region_rows, 1,
             TEMPLATE_SCORE_MAX_ANCHORS);
  coarse.validate();
  medium.validate();
  refine.validate();
  edge_claims.validate();
}

}  // namespace edgescout
