#include "host/detect/same_pose.h"

namespace edgescout {

void describe(SamePoseOptions& o, OptionVisitor& visit) {
  visit.group("Same pose");
  visit.number({"max-angle", "Largest angle between two poses that are the same, rad"},
               o.max_angle_rad, 1e-6, 3.2);
  visit.number({"max-distance", "Largest distance between two poses that are the same, m"},
               o.max_distance_m, 1e-9, 1.0);
  visit.number({"max-mspd",
                "Largest distance in the image between the vertices of two poses that are the "
                "same, px. It replaces --max-angle and --max-distance. 0: they decide",
                OptionLevel::Basic},
               o.max_mspd_px, 0.0, 10000.0);
}

void SamePoseOptions::validate() const { check_bounds(*this, "same_pose"); }

PoseError SamePose::error(const Se3& camera_from_object) const {
  return pose_error(camera_from_object, given_, object_.symmetries, options_.max_angle_rad,
                    options_.max_distance_m);
}

double SamePose::mspd_px(const Se3& camera_from_object) const {
  return edgescout::mspd_px(camera_from_object, given_, object_, camera_);
}

double SamePose::of_bounds(const Se3& camera_from_object) const {
  return options_.max_mspd_px > 0
             ? mspd_px(camera_from_object) / options_.max_mspd_px
             : error(camera_from_object).of_bounds(options_.max_angle_rad, options_.max_distance_m);
}

}  // namespace edgescout
