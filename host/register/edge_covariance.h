// Covariance of a pose from signed distances to edges, where the points of one edge share an error.
//
// Light, shadow, a bevel or the camera's grey curve displace a whole edge in the image by tenths of
// a pixel. A hundred points along it inform little more than ten. The model: the error of a
// distance is the sum of an error of its edge (variance a) and an error of its own (variance b).
// Then
//
//   covariance = H^-1 (b H + a M) H^-1
//   H = sum over points of w J J'
//   M = sum over edges of g g',  g = sum over the edge's points of w J
//
// with J the derivatives of the distances and w the points' weights. This is least squares with
// clustered errors (Liang and Zeger, Biometrika 1986). Theirs takes the errors' covariance from the
// distances themselves; one view has too few edges for that, so two variances model it here. a and
// b follow from the sums of squares within edges and between edges (analysis of variance),
// corrected for what the fitted pose removed from them.
//
// common_to_edges(explained) times this matrix is the covariance that edge_icp reports. The factor
// stands for what no distance shows: errors common to all edges (bright surfaces look larger than
// dark ones, parts stand in their own shadow) and wrong edges among the right ones. Where edges
// explain less of a pose, more of those that do are wrong.
#pragma once

#include <cstdint>
#include <map>

#include "host/core/se3.h"

namespace edgescout {

// Prior of the displacement of an edge: its standard deviation, and how many edges it counts for.
inline constexpr double EXPECTED_DISPLACEMENT_PX = 0.15;
inline constexpr double EXPECTED_FROM_EDGES = 4;

// Factor of the variances, by the share of the pose that edges explain: the sum of the weights of
// its points over the number of those visible inside the images. A power of the share, fitted so
// that the 95 % region holds 95 % of right poses; constant outside the shares of the fit
// (edge_covariance_weights.h). Falls with the share.
double common_to_edges(double explained);

// Numbers the edges of all views, from the orientation of a projected point and the signed distance
// of its line from the image's origin. Points on one straight line of a view share a number. Points
// on a curve share one per 15 degrees of the curve.
std::uint64_t edge_number(std::size_t view, double theta_rad, double offset_px);

class EdgeCovariance {
 public:
  // Adds a point at the signed distance `distance_px` from its edge, with a weight > 0. Points of
  // one edge have the same number `edge`; their signs must refer to the same side of it.
  void add(std::uint64_t edge, double distance_px, double weight, const Vector6d& jacobian);
  // Without common_to_edges. In the tangent of the jacobians. Infinite where the points do not
  // determine the pose.
  Matrix6d covariance() const;
  double weight() const;  // sum over all points

 private:
  struct Sums {
    Vector6d jacobian = Vector6d::Zero();
    double distance_px = 0, weight = 0;
    int points = 0;
  };
  Matrix6d hessian_ = Matrix6d::Zero();
  double squares_px2_ = 0;
  std::map<std::uint64_t, Sums> edges_;
};

}  // namespace edgescout
