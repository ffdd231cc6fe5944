// D2CO: registration of object poses directly on the DCD tensors of one or several views (paper,
// Secs. 4.1 and 4.3).
//
// Minimises E(pose) = sum over views, points of rho(DT3_view(x_i, xi_i)) by Levenberg-Marquardt
// over the tangent of core/se3.h at world_from_object (Eqs. 8 and 11). Projections and orientations
// are recomputed at every evaluation; the visible points at the start of every round. All poses of
// a call are refined side by side: one kernel call gives the systems of all of them in all views.
#pragma once

#include <memory>
#include <span>
#include <string>
#include <vector>

#include "host/edge/edge_index.h"
#include "host/model/visible_edges.h"

namespace edgescout {

// One stage of the schedule: the loss and how long it is kept.
struct D2coRound {
  std::uint32_t loss = LOSS_HUBER;
  float scale_px = 4;
  int iterations = 10;  // of Levenberg-Marquardt
  int max_points = 0;   // per view, evenly thinned; 0: all
};

struct D2coOptions {
  // From a wide loss to a narrow one; visible points are recomputed before every round.
  std::vector<D2coRound> rounds = default_rounds();
  double min_step_m = 2e-6;  // a smaller step ends the round
  double min_step_rad = 2e-5;
  VisibilityOptions visibility;
  static std::vector<D2coRound> default_rounds();
  void validate() const;
};

struct Occluders;  // occluders.h

// One calibrated view: the camera must be the one its tensor was made with.
struct RegisterView {
  ViewHandle view;
  Camera camera;
  Se3 camera_from_world;  // identity where the world is the camera frame
  std::shared_ptr<const EdgeIndex>
      edges;          // the edge points themselves; register_poses does without
  ViewHandle coarse;  // the same edges on a reduced tensor: a wider basin for the search (refine.h)
  std::shared_ptr<const Image>
      image;  // undistorted; for shading (shading.h) and baselines that look at grey
  std::shared_ptr<const Occluders> occluders;  // what known objects hide here; none: nothing
};

struct ObjectPose {
  int object = 0;  // index into the models
  Se3 world_from_object;
};

enum class Convergence { SmallStep, NoDecrease, IterationLimit, NoPoints };
std::string to_string(Convergence reason);

struct Registration {
  Se3 world_from_object;
  // inverse of the final J'WJ, times the residual variance: points taken for independent; of a
  // polished pose that of edge_covariance.h; infinite where singular
  Matrix6d covariance = Matrix6d::Zero();
  double cost_px2 = 0;  // final sum of rho over all points and views
  double mean_px = 0;   // mean residual
  int points = 0;       // in all views
  int iterations = 0;
  Convergence reason = Convergence::NoPoints;
};

// Covariance of a pose from its final system: variance * hessian^-1 in the tangent of core/se3.h,
// infinite where singular.
Matrix6d pose_covariance(const Matrix6d& hessian, double residual_variance);

// The same objects at their registered poses: starts for what comes next.
std::vector<ObjectPose> object_poses_of(std::span<const ObjectPose> starts,
                                        std::span<const Registration> registrations);

// Evenly; all of them where `most` is 0 or enough.
std::vector<ModelPoint> thinned(const std::vector<ModelPoint>& points, int most);

// Results in the order of the hypotheses. InputError: options out of bounds; LogicError: no view, a
// view or a start that stands nowhere, an object that no model is of.
std::vector<Registration> register_poses(std::span<const EdgeModel> models,
                                         std::span<const ObjectPose> hypotheses,
                                         std::span<const RegisterView> views, Backend& backend,
                                         const D2coOptions& options = {});

}  // namespace edgescout
