// Records pose_normal_equations (kernels/pose_normal_equations.h, pose_push.h).
#pragma once

#include <span>

#include "kernels/gpu/pose_plan.h"

namespace edgescout::gpu {

class PoseNormalEquations {
 public:
  // `min_groups` 0: as the device likes it.
  explicit PoseNormalEquations(const Device& device, std::uint32_t min_groups = 0);
  // How many problems from the front one batch takes: at least one.
  std::size_t that_fit(std::span<const PoseProblem> problems) const;
  void record(Batch& batch, std::span<const PoseView> views, const PosePoints& points,
              std::span<const PoseProblem> problems, const PoseLoss& loss);
  // After the batch has run: a system for every problem that was recorded last.
  void collect(std::span<NormalEquations> out) const;

 private:
  BandedKernel kernel_;
  std::uint32_t min_groups_;
  const Device& device_;
  PosePlan plan_;
  PoseBuffers buffers_;
};

}  // namespace edgescout::gpu
