// Checks the views' camera poses (extrinsics) against their images: objects registered over all
// views must also lie where each single image shows them.
#pragma once

#include <span>
#include <vector>

#include "host/register/refine.h"

namespace edgescout {

// Result for one view.
struct ExtrinsicsCheck {
  // How far the objects' points move in this image when they are registered on it alone: mean over
  // an object's points, median over the objects. 0 where `objects` is 0. Of two views that disagree
  // with each other both have the larger value.
  double residual_px = 0;
  int objects = 0;  // that this image and another one show, each by itself: only these count
  // Where the image shows no object at all: how many it should show, by the other images.
  int missing = 0;
  bool disagrees = false;
};

struct ExtrinsicsCheckOptions {
  double max_residual_px = 2;
  // An image shows an object from this probability on, of the pose registered on it alone.
  double min_probability = 0.3;
  // An image shows nothing of an object below this probability. A part that others cover lies
  // between the two. At most min_probability.
  double absent_probability = 0.03;
  // Of an object by all other images, for it to count as missing.
  double held_probability = 0.5;
  int max_missing = 1;  // one object may be hidden by something unknown
  D2coOptions joint = schedules::extrinsics(), single = schedules::extrinsics();
  PoseScoreOptions score = FeatureOptions{}.score;
};

// One result per view of the scene. `objects`: poses in the world, from which registration starts.
//
// The worst view above max_residual_px is flagged and left out, then the rest is checked again: one
// wrong camera pose spoils the joint registration of all others. Of two views that disagree with
// each other the later one is flagged. A view is also flagged where it shows nothing at all of more
// than max_missing objects that it should show: its pose is so wrong that registration does not
// find them.
//
// Nothing is flagged with fewer than two views or without objects. A scene of one object, or of two
// views, cannot distinguish a grossly wrong pose from a hidden object.
std::vector<ExtrinsicsCheck> extrinsics_check(const Scene& scene,
                                              std::span<const ObjectPose> objects,
                                              const ExtrinsicsCheckOptions& options = {});

// Copies a flag of `before`, the check of fewer images, to `now` where `now` had no object to check
// the image by: that the objects are gone does not make a camera pose right.
void keep_unrefuted_flags(std::span<const ExtrinsicsCheck> before, std::span<ExtrinsicsCheck> now);

// Logs one warning for each flag that `before`, the check of the images so far, did not have.
void log_disagreements(std::span<const ExtrinsicsCheck> checks,
                       std::span<const ExtrinsicsCheck> before = {});

}  // namespace edgescout
