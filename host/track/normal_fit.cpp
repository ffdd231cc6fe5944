#include "host/track/normal_fit.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "host/core/matrix6.h"
#include "host/core/pose_steps.h"
#include "host/model/visible_edges.h"
#include "host/register/edge_covariance.h"
#include "host/register/image_motion.h"
#include "host/register/lm_state.h"
#include "host/register/thresholds.h"

namespace edgescout {

namespace {

constexpr double matched_px = 1.5;
constexpr double covariance_scale_px = 0.8;  // as in the last round of edge_icp

// 1 for the expected contrast, 0 for one of another sign. Backgrounds change, so it chooses among
// edges and weakens them, but excludes none.
double agreement(float contrast, float expected) {
  if (expected == 0) return 1;
  const double ratio = contrast / expected;
  return ratio <= 0 ? 0 : std::min(ratio, 1 / ratio);
}

// The weight of an edge by the agreement of its contrast.
double trust_in(double agreement) {
  constexpr double least = 0.3;
  return least + (1 - least) * agreement;
}

// The edge of a point that explains it best, the point being displaced along the normal.
struct Match {
  double distance_px, agreement;
};
std::optional<Match> match_of(const NormalSearch& search, const LinePoint& point,
                              double displaced_px) {
  constexpr double px_of_disagreement = 3;
  std::optional<Match> best;
  double least = INFINITY;
  for (const LineEdge& edge : search.edges_of(point)) {
    const Match match{displaced_px - edge.offset_px,
                      agreement(edge.contrast, point.expected_contrast)};
    const double cost = std::abs(match.distance_px) + px_of_disagreement * (1 - match.agreement);
    if (cost < least) least = cost, best = match;
  }
  return best;
}

double geman_mcclure_weight(double distance_px, double scale_px) {
  const double s2 = scale_px * scale_px, q = s2 / (s2 + distance_px * distance_px);
  return q * q;
}

struct System {
  Matrix6d hessian = Matrix6d::Zero();
  Vector6d gradient = Vector6d::Zero();
  int matched = 0;
};

System system_at(const NormalSearch& search, const Intrinsics& k, const Se3& camera_from_object,
                 double scale_px) {
  System sum;
  const Pose pose = to_pose(camera_from_object);
  for (const LinePoint& point : search.points) {
    const PosedPoint<double> posed = pose_point<double>(pose, point.model);
    if (!can_be_seen(posed.point)) continue;
    const ProjectedEdge<double> at = project_edge(posed, k);
    const double displaced_px = point.nx * (at.u - point.u_px) + point.ny * (at.v - point.v_px);
    const std::optional<Match> match = match_of(search, point, displaced_px);
    if (!match) continue;
    const double weight =
        geman_mcclure_weight(match->distance_px, scale_px) * trust_in(match->agreement);
    const Vector6d motion = image_motion(point.nx, point.ny, posed, k);
    sum.hessian += weight * motion * motion.transpose();
    sum.gradient += weight * match->distance_px * motion;
    ++sum.matched;
  }
  return sum;
}

void add_surface(System& system, const WorldSystem& surface) {
  system.hessian += surface.hessian;
  system.gradient += surface.gradient;
}

void add_prior(System& system, const Se3& pose, const PosePrior& prior) {
  Vector6d weight;
  weight << Eigen::Vector3d::Constant(1 / (prior.sigma_m * prior.sigma_m)),
      Eigen::Vector3d::Constant(1 / (prior.sigma_rad * prior.sigma_rad));
  system.hessian.diagonal() += weight;
  system.gradient += weight.cwiseProduct(local_coordinates(prior.camera_from_object, pose));
}

// How well points displaced by every whole number of pixels lie on edges: a table of one line.
class ShiftVotes {
 public:
  ShiftVotes(const NormalSearch& search, const LinePoint& point, int reach)
      : votes_(2 * std::size_t(reach) + 1), reach_(reach) {
    for (const LineEdge& edge : search.edges_of(point))
      for (std::size_t s = 0; s < votes_.size(); ++s) {
        const double near = geman_mcclure_weight(double(s) - reach - edge.offset_px, matched_px) *
                            trust_in(agreement(edge.contrast, point.expected_contrast));
        votes_[s] = std::max(votes_[s], near);
      }
  }
  double at(double displaced_px) const {
    const auto s = int(std::lround(displaced_px)) + reach_;
    return s < 0 || s >= int(votes_.size()) ? 0 : votes_[std::size_t(s)];
  }

 private:
  std::vector<double> votes_;
  int reach_;
};

}  // namespace

Se3 fit_to_edges(const NormalSearch& search, const Camera& ideal, const Se3& camera_from_object,
                 const FitRound& round, const PosePrior& prior, const SurfaceFit* surface) {
  constexpr double min_step_m = 2e-6, min_step_rad = 2e-5;
  const Intrinsics k = intrinsics_of(ideal);
  Se3 pose = camera_from_object;
  for (int i = 0; i < round.iterations; ++i) {
    System system = system_at(search, k, pose, round.scale_px);
    if (system.matched < thresholds::MIN_POINTS) return camera_from_object;
    if (surface) add_surface(system, surface->system_at(pose, round.depth_sigmas));
    add_prior(system, pose, prior);
    const Vector6d step = -solve(system.hessian, system.gradient);
    if (!step.allFinite()) return camera_from_object;
    pose = retract(pose, step);
    if (is_small(step, min_step_m, min_step_rad)) break;
  }
  return pose;
}

Se3 shifted_to_edges(const NormalSearch& search, const Camera& ideal,
                     const Se3& camera_from_object) {
  const int reach = int(search.reach_px);
  std::vector<ShiftVotes> lines;
  lines.reserve(search.points.size());
  for (const LinePoint& point : search.points) lines.emplace_back(search, point, reach);
  double most = -1;
  Eigen::Vector2d best_px(0, 0);
  for (int dy = -reach; dy <= reach; ++dy)
    for (int dx = -reach; dx <= reach; ++dx) {
      double votes = 0;
      for (std::size_t i = 0; i < lines.size(); ++i)
        votes += lines[i].at(search.points[i].nx * dx + search.points[i].ny * dy);
      if (votes > most) most = votes, best_px = {dx, dy};
    }
  Se3 shifted = camera_from_object;
  const double depth_m = shifted.translation_m.z();
  shifted.translation_m.x() += best_px.x() / ideal.fx * depth_m;
  shifted.translation_m.y() += best_px.y() / ideal.fy * depth_m;
  return shifted;
}

double NormalFit::above_chance() const {
  return by_chance < 1 ? std::max(0.0, (matched - by_chance) / (1 - by_chance)) : 0;
}

NormalFit measure_fit(const NormalSearch& search, const Camera& ideal,
                      const Se3& camera_from_object, const SurfaceFit* surface) {
  NormalFit fit;
  EdgeCovariance covariance;
  const Intrinsics k = intrinsics_of(ideal);
  const Pose pose = to_pose(camera_from_object);
  double matched = 0, by_chance = 0;
  for (const LinePoint& point : search.points) {
    const PosedPoint<double> posed = pose_point<double>(pose, point.model);
    const ProjectedEdge<double> at = project_edge(posed, k);
    ++fit.points;
    double other_px = 0;  // of the line, within matched_px of an edge that is not the point's
    for (const LineEdge& edge : search.edges_of(point))
      if (std::abs(edge.offset_px) > 2 * matched_px) other_px += 2 * matched_px;
    by_chance += std::min(1.0, other_px / (2 * search.reach_px - 4 * matched_px));
    const std::optional<Match> match = match_of(search, point, 0);
    if (!match || std::abs(match->distance_px) > 3 * matched_px) continue;
    matched += std::abs(match->distance_px) < matched_px;
    const double theta = orientation(at.dx, at.dy), nx = -std::sin(theta), ny = std::cos(theta);
    const double sign = point.nx * nx + point.ny * ny < 0 ? -1 : 1;
    covariance.add(edge_number(0, theta, nx * at.u + ny * at.v), sign * match->distance_px,
                   geman_mcclure_weight(match->distance_px, covariance_scale_px),
                   sign * image_motion(point.nx, point.ny, posed, k));
  }
  if (fit.points == 0) return fit;
  fit.matched = matched / fit.points;
  fit.by_chance = by_chance / fit.points;
  fit.explained = std::min(1.0, covariance.weight() / fit.points);
  fit.covariance = common_to_edges(fit.explained) * covariance.covariance();
  if (!surface) return fit;
  surface->add_information(fit.covariance, camera_from_object);
  fit.depth = surface->evidence_at(camera_from_object);
  return fit;
}

}  // namespace edgescout
