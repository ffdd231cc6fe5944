// One model point under one pose: where it lands, how its edge is oriented there, and how both move
// with the pose.
#pragma once

#include <cmath>

#include "kernels/pose_normal_equations.h"

namespace edgescout {

template <typename T>
struct Vec3 {
  T x, y, z;
};
template <typename T>
Vec3<T> cross(const Vec3<T>& a, const Vec3<T>& b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
template <typename T>
Vec3<T> rotate(const Pose& pose, T x, T y, T z) {
  const float* m = pose.m;
  return {m[0] * x + m[1] * y + m[2] * z, m[4] * x + m[5] * y + m[6] * z,
          m[8] * x + m[9] * y + m[10] * z};
}

// In the camera frame: the point about the object's origin, the point itself and its edge's
// tangent.
template <typename T>
struct PosedPoint {
  Vec3<T> arm, point, tangent;
};
template <typename T>
PosedPoint<T> pose_point(const Pose& pose, const ModelPoint& model) {
  const Vec3<T> arm = rotate<T>(pose, model.x_m, model.y_m, model.z_m);
  return {arm,
          {arm.x + pose.m[3], arm.y + pose.m[7], arm.z + pose.m[11]},
          rotate<T>(pose, model.tx, model.ty, model.tz)};
}

// Whether it is in front of the camera, and nowhere that arithmetic in float loses it.
template <typename T>
bool can_be_seen(const Vec3<T>& point) {
  constexpr T range = T(POSE_MAX_RANGE_M);
  return point.z > T(POSE_MIN_DEPTH_M) && point.z < range && std::abs(point.x) < range &&
         std::abs(point.y) < range;
}

// Projection of the point, and of its tangent up to a positive factor: d = z^2 *
// d(projection)(tangent).
template <typename T>
struct ProjectedEdge {
  T u, v, dx, dy;
};
template <typename T>
ProjectedEdge<T> project_edge(const PosedPoint<T>& p, const Intrinsics& k) {
  const T inverse = T(1) / p.point.z;
  return {k.fx * p.point.x * inverse + k.cx, k.fy * p.point.y * inverse + k.cy,
          k.fx * (p.point.z * p.tangent.x - p.point.x * p.tangent.z),
          k.fy * (p.point.z * p.tangent.y - p.point.y * p.tangent.z)};
}

// Whether it lies on one of the image's pixels.
template <typename T>
bool on_image(const ProjectedEdge<T>& at, int width, int height) {
  return at.u >= T(-0.5) && at.u < width - T(0.5) && at.v >= T(-0.5) && at.v < height - T(0.5);
}

// Orientation in [0, pi).
template <typename T>
T orientation(T dx, T dy) {
  constexpr T pi = T(3.14159265358979323846);
  T theta = std::atan2(dy, dx);
  if (theta < 0) theta += pi;
  return theta >= pi ? theta - pi : theta;
}

}  // namespace edgescout
