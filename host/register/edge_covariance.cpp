#include "host/register/edge_covariance.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "host/core/pose_steps.h"
#include "host/register/edge_covariance_weights.h"

namespace edgescout {

double common_to_edges(double explained) {
  constexpr edge_covariance_weights::CommonToEdges fitted =
      edge_covariance_weights::COMMON_TO_EDGES;
  const double share = std::clamp(explained, fitted.least_explained, fitted.most_explained);
  return fitted.of_all * std::pow(share, fitted.power);
}

std::uint64_t edge_number(std::size_t view, double theta_rad, double offset_px) {
  constexpr double arc_rad = std::numbers::pi / 12, width_px = 4;
  constexpr std::int64_t arcs = 16, offsets = 1 << 24;  // more than there are of either
  const auto arc = std::int64_t(theta_rad / arc_rad),
             offset = std::int64_t(std::floor(offset_px / width_px));
  return std::uint64_t((std::int64_t(view) * arcs + arc) * offsets + offset + offsets / 2);
}

double EdgeCovariance::weight() const {
  double sum = 0;
  for (const auto& [edge, sums] : edges_) sum += sums.weight;
  return sum;
}

void EdgeCovariance::add(std::uint64_t edge, double distance_px, double weight,
                         const Vector6d& jacobian) {
  Sums& sums = edges_[edge];
  sums.jacobian += weight * jacobian;
  sums.distance_px += weight * distance_px;
  sums.weight += weight;
  ++sums.points;
  hessian_ += weight * jacobian * jacobian.transpose();
  squares_px2_ += weight * distance_px * distance_px;
}

Matrix6d EdgeCovariance::covariance() const {
  Matrix6d inverse = pose_covariance(hessian_, 1);
  if (!inverse.allFinite()) return inverse;
  Matrix6d by_edge = Matrix6d::Zero(), by_weighted_edge = Matrix6d::Zero();
  double weight = 0, squared_weight = 0, explained_px2 = 0, between_px2 = 0, free_within = 0;
  for (const auto& [edge, sums] : edges_) {
    by_edge += sums.jacobian * sums.jacobian.transpose();
    by_weighted_edge += sums.weight * sums.jacobian * sums.jacobian.transpose();
    weight += sums.weight;
    squared_weight += sums.weight * sums.weight;
    explained_px2 += sums.distance_px * sums.distance_px / sums.weight;
    between_px2 += sums.distance_px * sums.distance_px;
    free_within += sums.weight * (1 - 1.0 / sums.points);
  }
  // With the pose at its optimum: E[within] = b free_within, E[between] = a free_between + b
  // own_between.
  const double own_px2 = std::max(0.0, squares_px2_ - explained_px2) / std::max(1.0, free_within);
  const Matrix6d taken = inverse * by_edge;
  const double own_between = std::max(0.0, weight - taken.trace()),
               free_between =
                   std::max(0.0, squared_weight - 2 * (inverse * by_weighted_edge).trace() +
                                     (taken * taken).trace());
  const double expected_free = EXPECTED_FROM_EDGES * squared_weight / double(edges_.size()),
               expected_px2 = EXPECTED_DISPLACEMENT_PX * EXPECTED_DISPLACEMENT_PX;
  const double shared_px2 =
      (expected_free * expected_px2 + std::max(0.0, between_px2 - own_between * own_px2)) /
      (expected_free + free_between);
  const Matrix6d covariance = own_px2 * inverse + shared_px2 * taken * inverse;
  return 0.5 * (covariance + covariance.transpose());
}

}  // namespace edgescout
