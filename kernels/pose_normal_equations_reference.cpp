// Eqs. 8 and 11 term by term, in double: the judge of the fast path and of the device.
#include <cmath>

#include "kernels/error.h"
#include "kernels/pose_geometry.h"

namespace edgescout {

namespace {

struct Residual {
  double value;        // px
  double jacobian[6];  // px by [m, rad]
};

Residual residual_of(const TensorView& view, const PosedPoint<double>& p) {
  const Intrinsics& k = view.intrinsics;
  const ProjectedEdge<double> edge = project_edge(p, k);
  float slope[3];
  Residual r;
  r.value = tensor_lookup(view, float(edge.u), float(edge.v), float(orientation(edge.dx, edge.dy)),
                          slope);
  const double z = p.point.z;
  // By the point: through the projection and through the orientation, xi = atan2(dy, dx).
  const double norm2 = edge.dx * edge.dx + edge.dy * edge.dy;
  const double least = POSE_MIN_FORESHORTENING * k.fx * z;
  const bool oriented = norm2 > least * least;
  const double along_x =
      oriented ? -slope[2] * edge.dy / norm2 * k.fx : 0;  // by the x part of d, without fx
  const double along_y = oriented ? slope[2] * edge.dx / norm2 * k.fy : 0;
  const Vec3<double> by_point{
      slope[0] * k.fx / z - along_x * p.tangent.z, slope[1] * k.fy / z - along_y * p.tangent.z,
      -(slope[0] * k.fx * p.point.x + slope[1] * k.fy * p.point.y) / (z * z) +
          along_x * p.tangent.x + along_y * p.tangent.y};
  const Vec3<double> by_tangent{along_x * z, along_y * z,
                                -along_x * p.point.x - along_y * p.point.y};
  const Vec3<double> turn_point = cross(p.arm, by_point),
                     turn_tangent = cross(p.tangent, by_tangent);
  const double jacobian[6] = {by_point.x,
                              by_point.y,
                              by_point.z,
                              turn_point.x + turn_tangent.x,
                              turn_point.y + turn_tangent.y,
                              turn_point.z + turn_tangent.z};
  for (int i = 0; i < 6; ++i) r.jacobian[i] = jacobian[i];
  return r;
}

struct Weighted {
  double cost, weight;
};
Weighted apply_loss(const PoseLoss& loss, double r) {
  const double s = loss.scale_px;
  if (loss.kind == LOSS_HUBER)
    return r <= s ? Weighted{0.5 * r * r, 1.0} : Weighted{s * (r - 0.5 * s), s / r};
  const double q = s * s / (s * s + r * r);
  return {0.5 * q * r * r, q * q};
}

struct Sums {
  double hessian[21] = {}, gradient[6] = {}, cost = 0, residual = 0, weight = 0, points = 0,
         behind = 0;
};

NormalEquations to_float(const Sums& s) {
  NormalEquations out;
  for (int i = 0; i < 21; ++i) out.hessian[i] = float(s.hessian[i]);
  for (int i = 0; i < 6; ++i) out.gradient[i] = float(s.gradient[i]);
  out.cost = float(s.cost);
  out.residual_sum = float(s.residual);
  out.weight_sum = float(s.weight);
  out.points = float(s.points);
  out.behind = float(s.behind);
  return out;
}

}  // namespace

void pose_normal_equations_reference(std::span<const TensorView> views,
                                     std::span<const ModelPoint> points,
                                     std::span<const PoseProblem> problems, const PoseLoss& loss,
                                     std::span<NormalEquations> out) {
  check(out.size() == problems.size(), "pose_normal_equations: as many systems as problems");
  for (std::size_t i = 0; i < problems.size(); ++i) {
    const PoseProblem& problem = problems[i];
    Sums sums;
    for (const ModelPoint& model : points.subspan(problem.first_point, problem.point_count)) {
      const PosedPoint<double> posed = pose_point<double>(problem.camera_from_object, model);
      if (!can_be_seen(posed.point)) {
        sums.behind += 1;
        continue;
      }
      const Residual r = residual_of(views[problem.view], posed);
      const auto [cost, weight] = apply_loss(loss, r.value);
      int entry = 0;
      for (int a = 0; a < 6; ++a) {
        for (int b = a; b < 6; ++b) sums.hessian[entry++] += weight * r.jacobian[a] * r.jacobian[b];
        sums.gradient[a] += weight * r.value * r.jacobian[a];
      }
      sums.cost += cost;
      sums.residual += r.value;
      sums.weight += weight;
      sums.points += 1;
    }
    out[i] = to_float(sums);
  }
}

}  // namespace edgescout
