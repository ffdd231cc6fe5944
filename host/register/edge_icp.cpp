#include "host/register/edge_icp.h"

#include <algorithm>
#include <numbers>
#include <optional>

#include "host/core/matrix6.h"
#include "host/core/options.h"
#include "host/core/pose_steps.h"
#include "host/core/thinned.h"
#include "host/register/contested_edges.h"
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

LineResidual residual_to(const EdgePoint& edge, const Eigen::Vector2f& normal,
                         const PosedPoint<double>& p, const ProjectedEdge<double>& projected,
                         const Intrinsics& k) {
  const double nx = normal.x(), ny = normal.y();
  return {nx, ny, nx * (projected.u - edge.x_px) + ny * (projected.v - edge.y_px),
          image_motion(nx, ny, p, k)};
}

struct Counts {
  int points = 0, in_image = 0, matched = 0;
};

// A model point and the edge point that it takes.
struct Match {
  const EdgePoint* edge;
  LineResidual residual;
  ProjectedEdge<double> projected;
};

// [R, 0; 0, R]: maps the world's tangent to the camera's (lm_state.h).
Matrix6d camera_tangent(const ObjectView& view) {
  Matrix6d camera_from_world = Matrix6d::Zero();
  camera_from_world.topLeftCorner<3, 3>() = camera_from_world.bottomRightCorner<3, 3>() =
      view.camera_from_world.rotation.toRotationMatrix();
  return camera_from_world;
}

struct LineSystem {
  Matrix6d hessian = Matrix6d::Zero();
  Vector6d gradient = Vector6d::Zero();
  double weight = 0;  // of edges and depth
  double edge_weight = 0;
  Counts counts;
};

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
  return {in_world.hessian, in_world.gradient, double(found.weight_sum), 0, {}};
}

// What the iterations of all rounds came to.
struct Iterated {
  Se3 pose;
  Convergence convergence = Convergence::TooFewEdges;
  double last_step_px = 0;
  double explained = 0;  // share of the points inside the images that edges explain, by weight
};

// The visible edges and surfaces of one pose, compared with the views.
class PoseIcp {
 public:
  PoseIcp(std::span<const ObjectView> views, std::span<const VisibleInView> visible,
          const PoseDepthOptions& depth, const EdgeIcpOptions& options)
      : views_(views), visible_(visible), depth_(depth), options_(options) {
    contested_.resize(views.size());
    const bool is_dense = options.max_points == 0;  // thinned lines leave stretches to others
    for (std::size_t v = 0; v < views.size(); ++v)
      if (is_dense && views[v].edges) contested_[v].emplace(*views[v].edges);
  }

  Iterated iterate(const Se3& start) {
    Iterated at{start};
    for (const EdgeIcpRound& round : options_.rounds) {
      at.convergence = Convergence::IterationLimit;
      for (int i = 0; i < round.iterations; ++i) {
        LineSystem system = system_at(at.pose, round);
        if (!enough(system)) return {start};
        system.hessian.diagonal() *= 1 + 1e-4;  // no motion in directions that no edge determines
        const Vector6d step = -solve(system.hessian, system.gradient);
        if (!step.allFinite()) return {start};
        at.pose = retract(at.pose, step);
        at.last_step_px = rms_motion_px(step, system.hessian, system.weight);
        if (is_small(step, options_.min_step_m, options_.min_step_rad)) {
          at.convergence = Convergence::Converged;
          break;
        }
      }
    }
    const LineSystem last = system_at(at.pose, options_.rounds.back());
    at.explained = share(last.edge_weight, last.counts.in_image);
    return enough(last) ? at : Iterated{start};
  }

  // As Iterated::explained.
  double explained(const Se3& pose) {
    const LineSystem system = system_at(pose, options_.rounds.back());
    return share(system.edge_weight, system.counts.in_image);
  }

  // At the estimate's pose.
  void set_covariance(PoseEstimate& estimate) {
    EdgeCovariance sum;
    double in_image = 0;
    for (std::size_t v = 0; v < views_.size(); ++v) {
      const Matrix6d to_camera = camera_tangent(views_[v]);
      const auto add = [&](const LineResidual& r, double weight, const ProjectedEdge<double>& p) {
        const double theta = orientation(p.dx, p.dy), nx = -std::sin(theta), ny = std::cos(theta);
        // The edge's direction may have wrapped at pi where the point's has not.
        const double sign = r.nx * nx + r.ny * ny < 0 ? -1 : 1;
        sum.add(edge_number(v, theta, nx * p.u + ny * p.v), sign * r.value, weight,
                sign * to_camera.transpose() * r.jacobian);
      };
      in_image += match_points(v, estimate.world_from_object, options_.rounds.back(), add).in_image;
    }
    estimate.explained = share(sum.weight(), in_image);
    estimate.covariance = common_to_edges(estimate.explained) * sum.covariance();
    const LineSystem depth = depth_system_at(estimate.world_from_object);
    add_depth_information(estimate.covariance, depth.hessian, depth.weight);
  }

 private:
  static double share(double weight_sum, double in_image) {
    return std::min(1.0, weight_sum / std::max(1.0, in_image));
  }

  bool enough(const LineSystem& system) const {
    return system.counts.matched >= thresholds::MIN_POINTS &&
           system.counts.matched >= options_.min_matched * system.counts.points;
  }

  // Calls visit(residual, weight, projected point) for every point that keeps an edge point near.
  // Derivatives are by the camera's tangent.
  template <typename Visit>
  Counts match_points(std::size_t v, const Se3& world_from_object, const EdgeIcpRound& round,
                      const Visit& visit) {
    if (!views_[v].edges) return {};
    Counts counts = find_matches(v, world_from_object, round);
    if (contested_[v]) drop_contested(*contested_[v]);
    counts.matched = int(matches_.size());
    for (const Match& match : matches_) {
      const double value = match.residual.value, s2 = round.scale_px * round.scale_px,
                   q = s2 / (s2 + value * value);
      visit(match.residual, q * q, match.projected);
    }
    return counts;
  }

  // Of matches_.
  void drop_contested(ContestedEdges& contested) {
    contested.clear();
    for (const Match& match : matches_) contested.take(*match.edge, std::abs(match.residual.value));
    std::erase_if(matches_, [&](const Match& match) {
      return contested.is_lost(*match.edge, std::abs(match.residual.value));
    });
  }

  // Into matches_.
  Counts find_matches(std::size_t v, const Se3& world_from_object, const EdgeIcpRound& round) {
    const ObjectView& view = views_[v];
    const Pose pose = to_pose(view.camera_from_world * world_from_object);
    const Intrinsics k = intrinsics_of(view.camera);
    const EdgeReach reach(round.radius_px, options_.max_turn_rad);
    Counts counts;
    matches_.clear();
    for (const ModelPoint& model : visible_[v].points) {
      const PosedPoint<double> posed = pose_point<double>(pose, model);
      if (!can_be_seen(posed.point)) continue;
      ++counts.points;
      const ProjectedEdge<double> projected = project_edge(posed, k);
      counts.in_image += on_image(projected, view.camera.width, view.camera.height);
      const EdgePoint* edge =
          view.edges->nearest({float(projected.u), float(projected.v)},
                              {float(projected.dx), float(projected.dy)}, reach);
      if (edge)
        matches_.push_back({edge,
                            residual_to(*edge, view.edges->normal_of(*edge), posed, projected, k),
                            projected});
    }
    return counts;
  }

  LineSystem system_at(const Se3& pose, const EdgeIcpRound& round) {
    LineSystem sum = depth_system_at(pose);
    for (std::size_t v = 0; v < views_.size(); ++v) add_points(sum, v, pose, round);
    sum.weight += sum.edge_weight;
    return sum;
  }

  void add_points(LineSystem& sum, std::size_t v, const Se3& pose, const EdgeIcpRound& round) {
    Matrix6d hessian = Matrix6d::Zero();
    Vector6d gradient = Vector6d::Zero();
    const Counts counts =
        match_points(v, pose, round, [&](const LineResidual& r, double weight, const auto&) {
          hessian += weight * r.jacobian * r.jacobian.transpose();
          gradient += weight * r.value * r.jacobian;
          sum.edge_weight += weight;
        });
    const Matrix6d to_camera = camera_tangent(views_[v]);
    sum.hessian += to_camera.transpose() * hessian * to_camera;
    sum.gradient += to_camera.transpose() * gradient;
    sum.counts.points += counts.points;
    sum.counts.in_image += counts.in_image;
    sum.counts.matched += counts.matched;
  }

  LineSystem depth_system_at(const Se3& pose) const {
    LineSystem sum;
    for (std::size_t v = 0; v < views_.size(); ++v) {
      if (!views_[v].depth || visible_[v].surface.empty()) continue;
      const LineSystem of_view = depth_system(views_[v], pose, visible_[v].surface, depth_);
      sum.hessian += of_view.hessian;
      sum.gradient += of_view.gradient;
      sum.weight += of_view.weight;
    }
    return sum;
  }

  std::span<const ObjectView> views_;
  std::span<const VisibleInView> visible_;
  const PoseDepthOptions& depth_;
  const EdgeIcpOptions& options_;
  std::vector<std::optional<ContestedEdges>> contested_;  // by view; none: nothing is contested
  std::vector<Match> matches_;                            // of the last view
};

void register_to_edges(PoseEstimate& estimate, PoseIcp& icp) {
  const Iterated found = icp.iterate(estimate.world_from_object);
  const bool is_kept = found.convergence == Convergence::TooFewEdges;
  if (!is_kept || estimate.points > 0) estimate.convergence = found.convergence;
  if (is_kept) return;
  estimate.last_step_px = found.last_step_px;
  estimate.world_from_object = found.pose;
  icp.set_covariance(estimate);
}

// Calls run(pose's number, its PoseIcp) on all threads, unless no view has edges.
template <typename Run>
void for_each_pose(const Scene& scene, std::span<const PoseEstimate> poses,
                   const EdgeIcpOptions& options, const Run& run) {
  const auto takes_part = [](const ObjectView& view) { return view.edges != nullptr; };
  if (std::ranges::none_of(scene.views, takes_part)) return;
  Grid<VisibleInView> visible = visible_in_views(scene, object_poses(poses), options.visibility);
  for (VisibleInView& cell : visible.values())
    cell.points = thinned(cell.points, options.max_points);
  const PoseDepthOptions depth = pose_depth_options(scene, REGISTRATION_BAND);
  scene.backend.threads().for_each(poses.size(), [&](std::size_t p) {
    PoseIcp icp(scene.views, visible.row(p), depth, options);
    run(p, icp);
  });
}

// Tilted about two axes across the line of sight, and moved along it.
std::vector<Se3> starts_beside(const Se3& world_from_object, const EdgeModel& model,
                               const Se3& camera_from_world, const BasinHops& hops) {
  constexpr int tilts = 4;
  const Eigen::Quaterniond world_from_camera = camera_from_world.rotation.conjugate();
  const double distance_m = (camera_from_world * (world_from_object * model.center_m)).z();
  std::vector<Vector6d> moves;
  for (int i = 0; i < tilts; ++i) {
    const double angle = 2 * std::numbers::pi * i / tilts;
    moves.push_back(Vector6d::Zero());
    moves.back().tail<3>() =
        world_from_camera * Eigen::Vector3d(std::cos(angle), std::sin(angle), 0) * hops.tilt_rad;
  }
  for (const double sign : {-1.0, 1.0}) {
    moves.push_back(Vector6d::Zero());
    moves.back().head<3>() =
        world_from_camera * Eigen::Vector3d(0, 0, sign * hops.distance_share * distance_m);
  }
  std::vector<Se3> starts;
  for (const Vector6d& move : moves)
    starts.push_back(retract_about(world_from_object, model.center_m, move));
  return starts;
}

// Whether the pose has moved.
bool hop(PoseEstimate& estimate, PoseIcp& icp, std::span<const Se3> starts) {
  constexpr double least_gain = 0.005;
  double most = icp.explained(estimate.world_from_object) + least_gain;
  bool has_moved = false;
  for (const Se3& start : starts) {
    const Iterated found = icp.iterate(start);
    if (found.convergence == Convergence::TooFewEdges || found.explained <= most) continue;
    most = found.explained;
    has_moved = true;
    estimate.world_from_object = found.pose;
    estimate.convergence = found.convergence;
    estimate.last_step_px = found.last_step_px;
  }
  return has_moved;
}

}  // namespace

void EdgeIcpOptions::validate() const {
  const BoundsCheck in("edge_icp");
  for (const std::vector<EdgeIcpRound>* rounds_of : {&rounds, &hops.rounds}) {
    if (rounds_of->empty()) throw InputError("options", "edge_icp.rounds", "none", "at least one");
    for (const EdgeIcpRound& round : *rounds_of) {
      in.require("radius", round.radius_px, 0.01, EdgeIndex::MAX_RADIUS_PX);
      in.require("scale", round.scale_px, 1e-3, 1000);
      in.require("iterations", round.iterations, 1, 1000);
    }
  }
  in.require("hops.tilt", hops.tilt_rad, 0, 1);
  in.require("hops.distance_share", hops.distance_share, 0, 0.5);
  visibility.validate();
  in.require("max_turn", max_turn_rad, 0, 3.15);
  in.require("min_matched", min_matched, 0, 1);
  in.require("max_points", max_points, 0, 1e6);
  in.require("min_step_m", min_step_m, 0, 1e9);
  in.require("min_step_rad", min_step_rad, 0, 1e9);
}

void edge_icp(const Scene& scene, std::span<PoseEstimate> poses, const EdgeIcpOptions& options) {
  for_each_pose(scene, poses, options,
                [&](std::size_t p, PoseIcp& icp) { register_to_edges(poses[p], icp); });
}

std::vector<std::size_t> hop_basins(const Scene& scene, std::span<PoseEstimate> poses,
                                    const EdgeIcpOptions& options) {
  EdgeIcpOptions from_beside = options;
  from_beside.rounds = options.hops.rounds;
  std::vector<char> has_moved(poses.size());  // written by several threads: no vector<bool>
  for_each_pose(scene, poses, from_beside, [&](std::size_t p, PoseIcp& icp) {
    const std::vector<Se3> starts =
        starts_beside(poses[p].world_from_object, scene.models[std::size_t(poses[p].object)],
                      scene.views[0].camera_from_world, options.hops);
    has_moved[p] = hop(poses[p], icp, starts);
    if (has_moved[p]) icp.set_covariance(poses[p]);
  });
  std::vector<std::size_t> moved;
  for (std::size_t p = 0; p < poses.size(); ++p)
    if (has_moved[p]) moved.push_back(p);
  return moved;
}

}  // namespace edgescout
