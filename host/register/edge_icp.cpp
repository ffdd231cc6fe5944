#include "host/register/edge_icp.h"

#include <algorithm>

#include <Eigen/Cholesky>

#include "host/core/options.h"
#include "host/core/thinned.h"
#include "host/register/d2co.h"
#include "host/register/depth_systems.h"
#include "host/register/edge_covariance.h"
#include "host/register/image_motion.h"
#include "host/register/lm_state.h"
#include "host/register/measured_depth.h"
#include "host/register/thresholds.h"
#include "host/register/visible_in_views.h"
#include "kernels/error.h"
#include "kernels/thread_pool.h"

namespace edgescout {

namespace {

// A model point compared with its edge point: signed distance to the edge's tangent line, px, and
// the derivative of that distance by the camera's tangent.
struct LineResidual {
  double nx, ny;  // normal of the line
  double value;
  Vector6d jacobian;
};

LineResidual residual_to(const EdgePoint& edge, const PosedPoint<double>& p,
                         const ProjectedEdge<double>& projected, const Intrinsics& k) {
  const double nx = -std::sin(edge.theta_rad), ny = std::cos(edge.theta_rad);
  return {nx, ny, nx * (projected.u - edge.x_px) + ny * (projected.v - edge.y_px),
          image_motion(nx, ny, p, k)};
}

struct Counts {
  int points = 0, in_image = 0, matched = 0;
};

// Calls visit(residual, weight, projected point) for every point that has an edge point near.
// Derivatives are by the camera's tangent.
template <typename Visit>
Counts match_points(const ObjectView& view, const Se3& world_from_object,
                    std::span<const ModelPoint> points, const EdgeIcpRound& round,
                    float max_turn_rad, const Visit& visit) {
  const Pose pose = to_pose(view.camera_from_world * world_from_object);
  const Intrinsics k = intrinsics_of(view.camera);
  Counts counts;
  for (const ModelPoint& model : points) {
    const PosedPoint<double> posed = pose_point<double>(pose, model);
    if (!can_be_seen(posed.point)) continue;
    ++counts.points;
    const ProjectedEdge<double> projected = project_edge(posed, k);
    counts.in_image += on_image(projected, view.camera.width, view.camera.height);
    const EdgePoint* edge = view.edges->nearest(float(projected.u), float(projected.v),
                                                float(orientation(projected.dx, projected.dy)),
                                                round.radius_px, max_turn_rad);
    if (!edge) continue;
    ++counts.matched;
    const LineResidual r = residual_to(*edge, posed, projected, k);
    const double s2 = round.scale_px * round.scale_px, q = s2 / (s2 + r.value * r.value);
    visit(r, q * q, projected);
  }
  return counts;
}

// [R, 0; 0, R]: maps the world's tangent to the camera's (world_system.h).
Matrix6d camera_tangent(const ObjectView& view) {
  Matrix6d camera_from_world = Matrix6d::Zero();
  camera_from_world.topLeftCorner<3, 3>() = camera_from_world.bottomRightCorner<3, 3>() =
      view.camera_from_world.rotation.toRotationMatrix();
  return camera_from_world;
}

struct LineSystem {
  Matrix6d hessian = Matrix6d::Zero();
  Vector6d gradient = Vector6d::Zero();
  double weight = 0;
  Counts counts;
};

void add_points(LineSystem& sum, const ObjectView& view, const Se3& world_from_object,
                std::span<const ModelPoint> points, const EdgeIcpRound& round, float max_turn_rad) {
  Matrix6d hessian = Matrix6d::Zero();
  Vector6d gradient = Vector6d::Zero();
  const Counts counts = match_points(view, world_from_object, points, round, max_turn_rad,
                                     [&](const LineResidual& r, double weight, const auto&) {
                                       hessian += weight * r.jacobian * r.jacobian.transpose();
                                       gradient += weight * r.value * r.jacobian;
                                       sum.weight += weight;
                                     });
  const Matrix6d to_camera = camera_tangent(view);
  sum.hessian += to_camera.transpose() * hessian * to_camera;
  sum.gradient += to_camera.transpose() * gradient;
  sum.counts.points += counts.points;
  sum.counts.matched += counts.matched;
}

void set_covariance(PoseEstimate& estimate, std::span<const ObjectView> views,
                    std::span<const VisibleInView> visible, const EdgeIcpRound& round,
                    float max_turn_rad) {
  EdgeCovariance sum;
  double in_image = 0;
  for (std::size_t v = 0; v < views.size(); ++v) {
    if (!views[v].edges) continue;
    const Matrix6d to_camera = camera_tangent(views[v]);
    const auto add = [&](const LineResidual& r, double weight, const ProjectedEdge<double>& p) {
      const double theta = orientation(p.dx, p.dy), nx = -std::sin(theta), ny = std::cos(theta);
      // The edge's direction may have wrapped at pi where the point's has not.
      const double sign = r.nx * nx + r.ny * ny < 0 ? -1 : 1;
      sum.add(edge_number(v, theta, nx * p.u + ny * p.v), sign * r.value, weight,
              sign * to_camera.transpose() * r.jacobian);
    };
    in_image += match_points(views[v], estimate.world_from_object, visible[v].points, round,
                             max_turn_rad, add)
                    .in_image;
  }
  estimate.explained = std::min(1.0, sum.weight() / std::max(1.0, in_image));
  estimate.covariance = common_to_edges(estimate.explained) * sum.covariance();
}

// Of one view, in the world's tangent, in standard deviations. On the host: the threads have a pose
// each.
LineSystem depth_system(const ObjectView& view, const Se3& world_from_object,
                        std::span<const SurfacePoint> surface, const PoseDepthOptions& options) {
  const DepthImage& depth = view.depth->image;
  const DepthView measured{depth.z_m, depth.width, depth.height, intrinsics_of(view.camera)};
  const PoseProblem problem{to_pose(view.camera_from_world * world_from_object), 0,
                            std::uint32_t(surface.size()), 0};
  PoseDepth found;
  pose_depth_reference({&measured, 1}, surface, {&problem, 1}, options, {&found, 1});
  const WorldSystem in_world = world_system(found, view.camera_from_world);
  return {in_world.hessian, in_world.gradient, double(found.weight_sum), {}};
}

// The visible edges and surfaces of one pose.
struct PoseInViews {
  std::span<const ObjectView> views;
  std::span<const VisibleInView> visible;
  const PoseDepthOptions& depth;
};

LineSystem depth_system(const Se3& pose, const PoseInViews& in) {
  LineSystem sum;
  for (std::size_t v = 0; v < in.views.size(); ++v) {
    if (!in.views[v].depth || in.visible[v].surface.empty()) continue;
    const LineSystem of_view = depth_system(in.views[v], pose, in.visible[v].surface, in.depth);
    sum.hessian += of_view.hessian;
    sum.gradient += of_view.gradient;
    sum.weight += of_view.weight;
  }
  return sum;
}

LineSystem system_at(const Se3& pose, const PoseInViews& in, const EdgeIcpRound& round,
                     float max_turn_rad) {
  LineSystem sum;
  for (std::size_t v = 0; v < in.views.size(); ++v)
    if (in.views[v].edges)
      add_points(sum, in.views[v], pose, in.visible[v].points, round, max_turn_rad);
  const LineSystem depth = depth_system(pose, in);
  sum.hessian += depth.hessian;
  sum.gradient += depth.gradient;
  sum.weight += depth.weight;
  return sum;
}

bool enough(const LineSystem& system, const EdgeIcpOptions& options) {
  return system.counts.matched >= thresholds::MIN_POINTS &&
         system.counts.matched >= options.min_matched * system.counts.points;
}

// What the iterations of all rounds came to.
struct Iterated {
  Se3 pose;
  Convergence convergence = Convergence::TooFewEdges;
  double last_step_px = 0;
};

Iterated iterate(const Se3& start, const PoseInViews& in, const EdgeIcpOptions& options) {
  Iterated at{start};
  for (const EdgeIcpRound& round : options.rounds) {
    at.convergence = Convergence::IterationLimit;
    for (int i = 0; i < round.iterations; ++i) {
      LineSystem system = system_at(at.pose, in, round, options.max_turn_rad);
      if (!enough(system, options)) return {start};
      system.hessian.diagonal() *= 1 + 1e-4;  // no motion in directions that no edge determines
      const Vector6d step = -system.hessian.ldlt().solve(system.gradient);
      if (!step.allFinite()) return {start};
      at.pose = retract(at.pose, step);
      at.last_step_px = rms_motion_px(step, system.hessian, system.weight);
      if (is_small(step, options.min_step_m, options.min_step_rad)) {
        at.convergence = Convergence::Converged;
        break;
      }
    }
  }
  const LineSystem end = system_at(at.pose, in, options.rounds.back(), options.max_turn_rad);
  return enough(end, options) ? at : Iterated{start};
}

void edge_icp_of_one(PoseEstimate& estimate, const PoseInViews& in, const EdgeIcpOptions& options) {
  const Iterated found = iterate(estimate.world_from_object, in, options);
  const bool is_kept = found.convergence == Convergence::TooFewEdges;
  if (!is_kept || estimate.points > 0) estimate.convergence = found.convergence;
  if (is_kept) return;
  estimate.last_step_px = found.last_step_px;
  estimate.world_from_object = found.pose;
  set_covariance(estimate, in.views, in.visible, options.rounds.back(), options.max_turn_rad);
  const LineSystem depth = depth_system(found.pose, in);
  add_depth_information(estimate.covariance, depth.hessian, depth.weight);
}

}  // namespace

void EdgeIcpOptions::validate() const {
  const BoundsCheck in("edge_icp");
  if (rounds.empty()) throw InputError("options", "edge_icp.rounds", "none", "at least one");
  for (const EdgeIcpRound& round : rounds) {
    in.require("radius", round.radius_px, 0.01, EdgeIndex::CELL_PX);
    in.require("scale", round.scale_px, 1e-3, 1000);
    in.require("iterations", round.iterations, 1, 1000);
  }
  visibility.validate();
  in.require("max_turn", max_turn_rad, 0, 3.15);
  in.require("min_matched", min_matched, 0, 1);
  in.require("max_points", max_points, 0, 1e6);
  in.require("min_step_m", min_step_m, 0, 1e9);
  in.require("min_step_rad", min_step_rad, 0, 1e9);
}

void edge_icp(const Scene& scene, std::span<PoseEstimate> poses, const EdgeIcpOptions& options) {
  const auto takes_part = [](const ObjectView& view) { return view.edges != nullptr; };
  if (std::ranges::none_of(scene.views, takes_part)) return;
  Grid<VisibleInView> visible = visible_in_views(scene, object_poses(poses), options.visibility);
  for (VisibleInView& cell : visible.values())
    cell.points = thinned(cell.points, options.max_points);
  const PoseDepthOptions depth = pose_depth_options(scene, REGISTRATION_BAND);
  scene.backend.threads().for_each(poses.size(), [&](std::size_t p) {
    edge_icp_of_one(poses[p], {scene.views, visible.row(p), depth}, options);
  });
}

}  // namespace edgescout
