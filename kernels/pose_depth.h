// Compares the surfaces of many poses with measured depth: point-to-plane residuals with their 6x6
// systems (Chen and Medioni, Image and Vision Computing 1992), and how many points agree with the
// measurement, contradict it, or are hidden.
//
// One problem is one pose in one view; its points are samples of the object's surface with outward
// unit normals, object frame. With p = R x + t the point and n = R normal in the camera frame:
//   p nowhere (not finite), z <= POSE_MIN_DEPTH_M, or a coordinate beyond POSE_MAX_RANGE_M:
//     not counted
//   n . p > -MIN_FACING |p|: turned away; not counted
//   u = fx x/z + cx, v = fy y/z + cy, rounded to the nearest pixel (half up: floor(u + 0.5));
//     outside the image: `missing`
//   d the depth there; not within (0, POSE_MAX_RANGE_M): `missing`
// Else, with ray = [(u_px - cx)/fx, (v_px - cy)/fy, 1] of the pixel's centre, q = d ray is the
// measured point and
//   offset = d - (n . p) / (n . ray)          by how much it lies behind the point's tangent plane,
//                                             along the axis, m
//   sigma  = max(noise_floor_m, noise_per_m d^2)
// (n . ray >= 0, which rounding of the pixel can cause: `missing`.)
//   offset >  max(band_m, BAND_SIGMAS sigma): `contradicting`, the surface cannot be there
//   offset < -max(band_m, BAND_SIGMAS sigma): `hidden`, by something nearer
//   else:                                     `agreeing`
// Agreeing and contradicting points have the residual r and its derivative by the tangent of
// core/se3.h in the camera frame ([translation m, rotation rad], rotation about the object's
// origin), q and s being fixed:
//   r = n . (q - p) / s,  s = sqrt((sigma n . ray)^2 + surface_m^2)      in standard deviations
//   J = -[n, (q - t) x n] / s
//   hessian = sum w J J' (upper triangle, row by row),  gradient = sum w r J,  cost = sum rho(r)
//   rho = k^2/2 r^2 / (k^2 + r^2),  w = rho'(r) / r = (k^2 / (k^2 + r^2))^2,  k = loss_scale
// Hidden points have none: what hides them says nothing of them. Those that contradict keep their
// cost, so that no pose gains by leaving the measured surface.
// weight_sum and offset_m are over the points with a residual.
//
// Agreement: counts are equal but for points within 1e-3 px of a pixel's border, within 1e-3
// relative or 2e-6 z of a band's border, or within 1e-4 of turning away (n . p, or n . ray about
// 0), in total and of each kind. Sums over the other points agree to 1e-3 relative to the largest
// entry of their kind in the same system, and to what a change of every residual by 4e-7 |p| / s
// makes. (The reference accumulates in double, the others in float by groups of points. Float has p
// and q to 2e-7 |p|; at grazing, n . ray = -0.1, offset to ten times that.) LogicError: a point
// range or a view beyond the lists, outputs of another number, a depth image without pixels or of
// another size than its values, noise_floor_m, noise_per_m, band_m, surface_m or loss_scale that is
// not finite or negative; loss_scale must be positive, noise_floor_m at least DEPTH_MIN_NOISE_M
// (else residuals leave float).
#ifndef EDGESCOUT_POSE_DEPTH_H
#define EDGESCOUT_POSE_DEPTH_H

#include <cstddef>
#include <span>

#include "kernels/pose_normal_equations.h"
#include "kernels/types.h"

namespace edgescout {

class ThreadPool;

inline constexpr float MIN_FACING = 0.1f;  // cosine: more grazing surfaces are not compared
inline constexpr float DEPTH_MIN_NOISE_M = 1e-6f;
inline constexpr float BAND_SIGMAS = 4.0f;  // of agreement, at least

// A sample of a surface, object frame.
struct SurfacePoint {
  float x_m, y_m, z_m;
  float nx, ny, nz;
};

// Measured depth of one view. Values as in host/core/depth_image.h: z in m, 0: not measured.
struct DepthView {
  std::span<const float> z_m;
  int width = 0;
  int height = 0;
  Intrinsics intrinsics{};
};

struct PoseDepthOptions {
  float noise_floor_m = 5e-4f;  // of a measurement, standard deviation; the larger of both holds
  float noise_per_m = 1e-3f;    // at 1 m; grows with the distance squared
  float surface_m = 2e-4f;      // of the model's surface
  float band_m = 5e-3f;         // of agreement
  float loss_scale = 3.0f;      // standard deviations
};

struct PoseDepth {
  float hessian[21];
  float gradient[6];
  float cost;                                      // sum of rho
  float weight_sum;                                // sum of w
  float offset_m;                                  // sum of w * offset
  float agreeing, contradicting, hidden, missing;  // numbers of points
};

// LogicError where it has no pixels or not as many values.
void check_depth_view(const DepthView& view);
// LogicError as said above, of lists of `views` and `points` and of `results` outputs.
void check_pose_depth(std::size_t views, std::size_t points, std::span<const PoseProblem> problems,
                      const PoseDepthOptions& options, std::size_t results);

void pose_depth_reference(std::span<const DepthView> views, std::span<const SurfacePoint> points,
                          std::span<const PoseProblem> problems, const PoseDepthOptions& options,
                          std::span<PoseDepth> out);
void pose_depth_fast(std::span<const DepthView> views, std::span<const SurfacePoint> points,
                     std::span<const PoseProblem> problems, const PoseDepthOptions& options,
                     std::span<PoseDepth> out, ThreadPool& pool);

}  // namespace edgescout
#endif
