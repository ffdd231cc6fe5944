// Decides whether a pose is the same as a given one, for example the true one.
//
// Public header.
#pragma once

#include "host/core/options.h"
#include "host/core/pose_error.h"

namespace edgescout {

// When two poses of an object are the same one, modulo symmetry.
struct SamePoseOptions {
  double max_angle_rad = CORRECT_ANGLE_RAD;
  double max_distance_m = CORRECT_DISTANCE_M;
  // Above 0: MSPD below this decides in place of both. For given poses of uncertain distance.
  double max_mspd_px = 0;
  void validate() const;  // InputError naming the field and the violated bound
};

void describe(SamePoseOptions& options, OptionVisitor& visit);

// Compares poses of one object, in the camera frame, with a given one.
class SamePose {
 public:
  SamePose(const Object& object, const Camera& camera, const Se3& given,
           const SamePoseOptions& options)
      : object_(object), camera_(camera), given_(given), options_(options) {}

  PoseError error(const Se3& camera_from_object) const;
  double mspd_px(const Se3& camera_from_object) const;
  // The error in units of its bound: below 1 if the pose is the same.
  double of_bounds(const Se3& camera_from_object) const;
  bool operator()(const Se3& camera_from_object) const { return of_bounds(camera_from_object) < 1; }

 private:
  Object object_;
  Camera camera_;
  Se3 given_;
  SamePoseOptions options_;
};

}  // namespace edgescout
