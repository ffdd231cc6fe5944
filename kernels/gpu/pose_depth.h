// Records pose_depth (kernels/pose_depth.h, pose_depth_push.h).
#pragma once

#include <span>

#include "kernels/gpu/pose_plan.h"
#include "kernels/pose_depth.h"

namespace edgescout::gpu {

// One depth image as the kernel reads it.
struct DepthImageView {
  const RawBuffer* depth_m;
  int width, height;
  Intrinsics intrinsics;
};

// Room for one. Throws InputError where the device cannot hold or bind it.
Buffer<float> depth_buffer(const Device& device, int width, int height);

class PoseDepths {
 public:
  // `min_groups` 0: as the device likes it.
  explicit PoseDepths(const Device& device, std::uint32_t min_groups = 0);
  // How many problems from the front one batch takes: at least one.
  std::size_t that_fit(std::span<const PoseProblem> problems) const;
  // With options that check_pose_depth() has seen.
  void record(Batch& batch, std::span<const DepthImageView> views, const PosePoints& points,
              std::span<const PoseProblem> problems, const PoseDepthOptions& options);
  // After the batch has run: the sums of every problem that was recorded last.
  void collect(std::span<PoseDepth> out) const;

 private:
  Kernel kernel_;
  std::uint32_t min_groups_;
  const Device& device_;
  PosePlan plan_;
  PoseBuffers buffers_;
};

}  // namespace edgescout::gpu
