// Residuals and 6x6 systems of many poses on DCD tensors (paper, Eqs. 8 and 11).
//
// One problem is one pose in one view: its model points are projected, the tensor is read by
// trilinear interpolation in x, y and (circularly) orientation, and value and derivative come from
// the same interpolant. With r_i the value in px at point i and J_i its derivative by the tangent
// of core/se3.h in the camera frame ([translation m, rotation rad], rotation about the object's
// origin):
//   hessian  = sum w_i J_i J_i'   (upper triangle, row by row: 21 numbers)
//   gradient = sum w_i r_i J_i
//   cost     = sum rho(r_i),  w_i = rho'(r_i) / r_i
// Loss: LOSS_HUBER: rho = r^2/2 up to scale, linear beyond. LOSS_GEMAN_MCCLURE:
// rho = s^2/2 * r^2 / (s^2 + r^2), which forgets far points: for annealing.
//
// Outside the pixel centres, [0, width - 1], the value is the interpolant's at the nearest place
// inside plus the Euclidean distance to it in px: smooth, growing, pulling back. A point at or
// behind z = POSE_MIN_DEPTH_M counts in `behind` and nowhere else; so does one that lies
// POSE_MAX_RANGE_M away or nowhere (not finite), where a diverging registration may take it.
//
// Orientation: xi = atan2(dy, dx) mod pi of the projected tangent, d = d(projection) * (R tangent).
// An edge seen end on has none that could be trusted: where |d| < POSE_MIN_FORESHORTENING * fx / z
// the derivative by orientation counts as zero.
//
// Agreement: reference accumulates in double; the fast path and Vulkan in float by groups of
// points; sums agree to 1e-3 relative to the largest entry of their kind in the same system (order
// of summation and the device's atan2), but for points within 1e-3 px of the image's border or of a
// row or column of pixels, within as little of a bin's centre (there J jumps), and edges seen end
// on: float cannot keep those.
#ifndef EDGESCOUT_POSE_NORMAL_EQUATIONS_H
#define EDGESCOUT_POSE_NORMAL_EQUATIONS_H

#include "interop.h"

#ifdef __cplusplus
namespace edgescout {
#endif
EDGESCOUT_CONST(LOSS_HUBER, 0);
EDGESCOUT_CONST(LOSS_GEMAN_MCCLURE, 1);
EDGESCOUT_CONST(POSE_MAX_RANGE_M, 10000);  // of a point, along each axis of the camera
#ifdef __cplusplus
}  // namespace edgescout

#include <span>

#include "kernels/tensor_layout.h"
#include "kernels/types.h"

namespace edgescout {

class ThreadPool;

inline constexpr float POSE_MIN_DEPTH_M = 1e-3f;
inline constexpr float POSE_MIN_FORESHORTENING = 0.05f;

// A tensor with the camera that saw it.
struct TensorView {
  std::span<const std::uint16_t> tensor;
  TensorShape shape;
  Intrinsics intrinsics;
};

struct PoseProblem {
  Pose camera_from_object;
  std::uint32_t first_point;  // into the list of all problems' model points
  std::uint32_t point_count;
  std::uint32_t view;
};

struct PoseLoss {
  std::uint32_t kind = LOSS_HUBER;
  float scale_px = 4.0f;
};

struct NormalEquations {
  float hessian[21];
  float gradient[6];
  float cost;          // sum of rho, px^2
  float residual_sum;  // sum of r, px
  float weight_sum;    // sum of w
  float points;        // points in front of the camera
  float behind;        // points that were not, or nowhere
};

// Value in px at (x, y, theta) and, where `derivative` is not null, its derivatives by x, y (px/px)
// and theta (px/rad): the interpolant all paths share.
float tensor_lookup(const TensorView& view, float x_px, float y_px, float theta_rad,
                    float derivative[3]);

void pose_normal_equations_reference(std::span<const TensorView> views,
                                     std::span<const ModelPoint> points,
                                     std::span<const PoseProblem> problems, const PoseLoss& loss,
                                     std::span<NormalEquations> out);
void pose_normal_equations_fast(std::span<const TensorView> views,
                                std::span<const ModelPoint> points,
                                std::span<const PoseProblem> problems, const PoseLoss& loss,
                                std::span<NormalEquations> out, ThreadPool& pool);

}  // namespace edgescout
#endif
#endif
