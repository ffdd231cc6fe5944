// Records pose_score (kernels/pose_score.h, pose_push.h).
#pragma once

#include <span>

#include "kernels/gpu/pose_plan.h"
#include "kernels/pose_score.h"

namespace edgescout::gpu {

class PoseScorer {
 public:
  // `min_groups` 0: as the device likes it.
  explicit PoseScorer(const Device& device, std::uint32_t min_groups = 0);
  // How many problems from the front one batch takes: at least one.
  std::size_t that_fit(std::span<const PoseProblem> problems) const;
  // A view without a gradient scores psi = 0.
  void record(Batch& batch, std::span<const PoseView> views, const PosePoints& points,
              std::span<const PoseProblem> problems, const PoseScoreOptions& options);
  // After the batch has run: a score for every problem that was recorded last.
  void collect(std::span<PoseScore> out) const;

 private:
  BandedKernel kernel_;
  std::uint32_t min_groups_;
  const Device& device_;
  float cap_px_ = 0;
  PosePlan plan_;
  PoseBuffers buffers_;
};

}  // namespace edgescout::gpu
