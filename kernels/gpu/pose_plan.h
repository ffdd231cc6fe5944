// Many poses in many views as a few dispatches: what pose_normal_equations, pose_score and
// pose_depth have in common.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "kernels/gpu/batch.h"
#include "kernels/gpu/tensor.h"
#include "kernels/pose_normal_equations.h"
#include "kernels/pose_push.h"

namespace edgescout::gpu {

// One view as a kernel reads it. The gradient may be null.
struct PoseView {
  const DeviceTensor* tensor;
  Intrinsics intrinsics;
  const RawBuffer* gradient_x2;
};

// The points that problems name, of POSE_POINT_WORDS words each: in the host's memory and, where
// they stay for several calls, on the device.
struct PosePoints {
  std::span<const std::byte> host;
  const RawBuffer* on_device = nullptr;
  std::size_t count() const { return host.size() / point_bytes; }
  std::span<const std::byte> part(std::size_t first, std::size_t points) const {
    return host.subspan(first * point_bytes, points * point_bytes);
  }
  static constexpr std::size_t point_bytes = 4 * POSE_POINT_WORDS;
};

// Problems in the order of their views; a run of them is one dispatch. The device holds the points
// they name, [first_point, first_point + point_count).
struct PosePlan {
  struct Run {
    std::uint32_t view, first, count;
  };
  std::uint32_t first_point = 0, point_count = 0;
  std::vector<std::uint32_t> order;
  std::vector<Run> runs;
  std::uint32_t parts = 1;  // workgroups a problem
};

// `min_groups`: workgroups that keep the device busy. Throws LogicError on problems that break the
// contract.
PosePlan plan_poses(std::span<const PoseProblem> problems, std::size_t points, std::size_t views,
                    std::uint32_t min_groups);
// How many problems from the front a device binds at once, with the points they name and `sums`
// floats of results each: at least one.
std::size_t poses_that_fit(const Device& device, std::span<const PoseProblem> problems,
                           std::uint32_t sums);
// Workgroups that keep the device busy: many on a graphics card (or where tests ask for one's ways:
// staging), one on a processor's few cores.
std::uint32_t groups_to_fill(const Device& device);

PoseCamera pose_camera(const Intrinsics& intrinsics);

// The device's copy of points and problems, and the sums that come back, `sums` floats a problem
// and part.
class PoseBuffers {
 public:
  explicit PoseBuffers(const Device& device) : device_(device) {}
  void upload(Batch& batch, const PosePlan& plan, const PosePoints& points,
              std::span<const PoseProblem> problems, std::uint32_t sums);
  void download(Batch& batch) { batch.download<float>(results_, host_results_); }
  // Sums of the n-th problem of the plan's order over its parts, after the batch has run.
  void total(const PosePlan& plan, std::size_t n, std::span<double> totals) const;

  const RawBuffer& points() const { return *bound_points_; }
  const RawBuffer& problems() const { return problems_; }
  const RawBuffer& results() const { return results_; }

 private:
  const Device& device_;
  Buffer<std::byte> points_;  // of a call whose points do not stay
  const RawBuffer* bound_points_ = nullptr;
  Buffer<PoseProblem> problems_;
  Buffer<float> results_;
  std::vector<float> host_results_;
};

}  // namespace edgescout::gpu
