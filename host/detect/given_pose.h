// A pose that is known to be right, and how near to it the poses of a detection lie.
#pragma once

#include <optional>
#include <vector>

#include "host/detect/explain.h"

namespace edgescout {

// By the features over all views.
double rank_of(const PoseEstimate& pose);         // PoseClassifier::rank
double probability_of(const PoseEstimate& pose);  // PoseClassifier::probability

// Poses that a stage held, with their errors from the given pose in units of the bounds (SamePose);
// infinite for another object.
struct HeldPoses {
  std::vector<PoseEstimate> poses;
  std::vector<double> of_bounds;

  std::size_t count_same() const;

  // The pose with the smallest error.
  std::optional<std::size_t> nearest() const;

  // Of the poses that are the same as the given one, that with the largest value.
  template <typename Value>
  std::optional<std::size_t> best_same(const Value& value) const {
    std::optional<std::size_t> best;
    for (std::size_t i = 0; i < poses.size(); ++i)
      if (of_bounds[i] < 1 && (!best || value(poses[i]) > value(poses[*best]))) best = i;
    return best;
  }
};

// What the stages of a detection held.
struct ComparedStages {
  HeldPoses medium, candidates, fine, competing;
  const SelectionTrace& selection;
};

class GivenPose {
 public:
  // `given` is in the frame of `camera`, its object that of `set`.
  GivenPose(const TemplateSet& set, const Camera& camera, const ObjectPose& given,
            const SamePoseOptions& same);

  const ObjectPose& pose() const { return given_; }

  // The error of a pose in units of the bounds; below 1 it is the same pose.
  double of_bounds(const ObjectPose& pose) const;

  // Whether a hit of the scan lies so near that alignment should move it to the given pose.
  bool is_near(const Se3& camera_from_object) const { return is_near_(camera_from_object); }

  ComparedStages compared(const DetectTrace& trace) const;

  FoundPose found(const PoseEstimate& pose) const;
  std::optional<FoundPose> found(const HeldPoses& held, std::optional<std::size_t> index) const;

 private:
  HeldPoses compared(std::vector<PoseEstimate> poses) const;

  // Poses of a search, which do not have the index of their object.
  HeldPoses of_search(std::vector<PoseEstimate> poses) const;

  ObjectPose given_;
  SamePose is_same_, is_near_;
};

}  // namespace edgescout
