// Whether the views' camera poses agree with their images: objects registered over all views must
// also lie where each single image has them.
#pragma once

#include <span>
#include <vector>

#include "host/register/refine.h"

namespace edgescout {

struct ExtrinsicsCheck {
  double residual_px =
      0;  // median over the objects of how far their points move in this image when only it
          // has a say; 0 where `objects` is 0. Of two that disagree both have the larger
  int objects = 0;  // that it and another image show, each by itself: these can be judged in it
  int missing =
      0;  // where none shows at all: objects that the others hold and this one should show
  bool disagrees = false;
};

struct ExtrinsicsCheckOptions {
  double max_residual_px = 2;
  double min_probability =
      0.3;  // of an object's pose registered on the one image alone, for it to judge
  // below it an object does not show at all; a part that others cover lies between the two. At most
  // min_probability
  double absent_probability = 0.03;
  double held_probability =
      0.5;              // of an object by the other images together, for an image to miss it
  int max_missing = 1;  // one object may be hidden by what nobody knows
  D2coOptions joint = joint_defaults(), single = single_defaults();
  PoseScoreOptions score{1.0f, 4.0f, 60.0f};
  static D2coOptions joint_defaults();
  static D2coOptions single_defaults();
};

// One a view. The worst view above max_residual_px is flagged and left out, then the rest are
// judged again: one wrong pose spoils the joint registration for all others. Of two views that
// disagree with each other the later is flagged. So is one that shows not a trace of several
// objects that it should: its pose is so wrong that registration does not find them. Fewer than two
// views or no objects: nothing can disagree; a scene of one object, or of two views, does not tell
// a grossly wrong pose from an object that is hidden.
std::vector<ExtrinsicsCheck> extrinsics_check(std::span<const EdgeModel> models,
                                              std::span<const ObjectPose> objects,
                                              std::span<const RegisterView> views, Backend& backend,
                                              const ExtrinsicsCheckOptions& options = {});

// What `before`, the same of fewer images, said of an image that nothing could judge this time
// stands: that the objects are gone is no word for its pose.
void keep_flags(std::span<const ExtrinsicsCheck> before, std::span<ExtrinsicsCheck> now);

// A warning in the log for each flag that `before`, the same of the images so far, did not have.
void warn_of(std::span<const ExtrinsicsCheck> extrinsics_checks,
             std::span<const ExtrinsicsCheck> before = {});

}  // namespace edgescout
