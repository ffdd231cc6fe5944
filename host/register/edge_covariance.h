// Covariance of a pose from signed distances to edges, where all points of one edge err together.
//
// Light, shadow, a bevel or the camera's grey curve displace an edge in the image as a whole, by
// tenths of a pixel: a hundred points along it tell little more than ten. With J the derivatives of
// the distances, w the points' weights and a distance's error the sum of one of its edge (variance
// a) and one of its own (b),
//
//   covariance = c H^-1 (b H + a M) H^-1,   H = sum over points of w J J',   M = sum over edges of
//   g g', g = sum over the edge's points of w J
//
// (least squares with clustered errors, Liang and Zeger, Biometrika 1986; their errors' covariance
// is modelled by two variances here, since one view has too few edges to take it from the distances
// as they are). The two are those that make the sums of squares within edges and between them what
// they are (analysis of variance); what the pose took out of them is given back. c is for what all
// edges have in common, which leaves no distance.
#pragma once

#include <cstdint>
#include <map>

#include "host/core/se3.h"

namespace edgescout {

// A priori an edge is displaced by this standard deviation, known as well as from so many edges.
inline constexpr double EXPECTED_DISPLACEMENT_PX = 0.15;
inline constexpr double EXPECTED_FROM_EDGES = 4;
// c: bright surfaces look larger than dark ones, parts stand in their own shadow. Over rendered
// scenes true errors were twice what the distances alone tell (tests/register/polish_test.cpp).
inline constexpr double COMMON_TO_EDGES = 4;

class EdgeCovariance {
 public:
  // A point `distance_px` off its edge, of weight > 0. `edge`: any number, equal where points err
  // together; their distances must have the sign of one side.
  void add(std::uint64_t edge, double distance_px, double weight, const Vector6d& jacobian);
  // In the jacobians' tangent; infinite where the points do not hold the pose.
  Matrix6d covariance() const;

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
