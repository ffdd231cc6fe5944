// One model point under one pose, and the tensor's interpolant at its projection. Included by the
// pose_* shaders after tensor_read.glsl.
#include "angle.glsl"

struct PosedPoint {
  vec3 arm;      // from the object's origin, camera axes
  vec3 point;    // in the camera frame
  vec3 tangent;
};

struct ProjectedEdge {
  vec2 at;         // px
  vec2 direction;  // z^2 times the projection of the tangent
};

struct Lookup {
  float value;    // px
  vec3 slope;     // by x, y (px/px) and orientation (px/rad)
};

PosedPoint pose_point(mat3 rotation, vec3 translation_m, vec3 model_m, vec3 model_tangent) {
  const vec3 arm = rotation * model_m;
  return PosedPoint(arm, arm + translation_m, rotation * model_tangent);
}

ProjectedEdge project_edge(PosedPoint p, PoseCamera camera) {
  const vec2 focal = vec2(camera.fx, camera.fy);
  return ProjectedEdge(focal * p.point.xy / p.point.z + vec2(camera.cx, camera.cy),
                       focal * (p.point.z * p.tangent.xy - p.point.xy * p.tangent.z));
}

// Trilinear, and linear beyond the border: value of the nearest border pixel plus the distance to
// it.
Lookup tensor_lookup(TensorGrid grid, vec2 at, float angle) {
  const vec2 last = vec2(float(grid.width) - 1.0, float(grid.height) - 1.0);
  const vec2 inside = clamp(at, vec2(0.0), last);
  const uvec2 p0 = min(uvec2(inside), uvec2(max(last - 1.0, vec2(0.0))));
  const uvec2 p1 = min(p0 + 1u, uvec2(last));
  const vec2 a = inside - vec2(p0);
  const float turn = angle * (float(grid.bins) / PI);
  const uint k0 = min(uint(turn), grid.bins - 1u), k1 = k0 + 1u == grid.bins ? 0u : k0 + 1u;
  const float ak = turn - float(k0);

  const vec4 below = vec4(tensor_at(grid, p0.x, p0.y, k0), tensor_at(grid, p1.x, p0.y, k0),
                          tensor_at(grid, p0.x, p1.y, k0), tensor_at(grid, p1.x, p1.y, k0)) / float(DCD_UNITS_PER_PX);
  const vec4 above = vec4(tensor_at(grid, p0.x, p0.y, k1), tensor_at(grid, p1.x, p0.y, k1),
                          tensor_at(grid, p0.x, p1.y, k1), tensor_at(grid, p1.x, p1.y, k1)) / float(DCD_UNITS_PER_PX);
  const vec4 rise = above - below, v = below + ak * rise;  // corners 00, 10, 01, 11
  const vec2 rows = mix(v.xz, v.yw, a.x), rise_rows = mix(rise.xz, rise.yw, a.x);
  const vec2 out_of = at - inside;
  const float beyond = length(out_of);
  Lookup result;
  result.value = mix(rows.x, rows.y, a.y) + beyond;
  result.slope.x = out_of.x != 0.0 ? out_of.x / beyond : mix(v.y - v.x, v.w - v.z, a.y);
  result.slope.y = out_of.y != 0.0 ? out_of.y / beyond : rows.y - rows.x;
  result.slope.z = mix(rise_rows.x, rise_rows.y, a.y) * (float(grid.bins) / PI);
  return result;
}
