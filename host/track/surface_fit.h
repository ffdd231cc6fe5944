// Compares the visible surface of an object with measured depth (kernels/pose_depth.h).
#pragma once

#include <vector>

#include "host/core/types.h"
#include "host/register/depth_systems.h"
#include "host/register/measured_depth.h"
#include "kernels/pose_depth.h"

namespace edgescout {

class ThreadPool;

// Of one object in one image. Everything that it refers to outlives it.
class SurfaceFit {
 public:
  // `visible`: samples of the object's surface that it does not hide itself. `ideal`: the camera of
  // the depth image.
  SurfaceFit(const MeasuredDepth& depth, const Camera& ideal, const EdgeModel& model,
             std::vector<SurfacePoint> visible, ThreadPool& threads);

  // One standard deviation of a sample counts as one pixel of an edge; all of them count as 25 at
  // most, so that edges still hold a pose where the sensor is biased. `loss_sigmas`: scale of the
  // loss.
  WorldSystem system_at(const Se3& camera_from_object, double loss_sigmas) const;
  // Adds what was measured at a pose to the covariance by its edges.
  void add_information(Matrix6d& covariance, const Se3& camera_from_object) const;
  DepthEvidence evidence_at(const Se3& camera_from_object) const;

 private:
  PoseDepth compared(const Se3& camera_from_object, double band, double loss_sigmas) const;

  const MeasuredDepth* depth_;
  Intrinsics intrinsics_;
  double diameter_m_;
  std::vector<SurfacePoint> visible_;
  ThreadPool* threads_;
};

}  // namespace edgescout
