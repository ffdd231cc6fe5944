// A template's point in the image, as template_project.h says. The including shader has included
// template_project.h.
#include "angle.glsl"

// Half away from zero.
ivec2 rounded_offset(vec2 px) {
  const vec2 far = vec2(float(TEMPLATE_PROJECT_FAR_PX)), near = clamp(px, -far, far);
  return ivec2(near + mix(vec2(0.5), vec2(-0.5), lessThan(near, vec2(0.0))));
}

uint bin_of(vec2 direction, uint bins) {
  const uint turn = uint(undirected_angle(direction) * (float(bins) / PI) + 0.5);
  return turn >= bins ? 0u : turn;
}

struct ImagePoint {
  ivec2 offset;
  uint bin;
  bool is_near;  // nearer than nearest_m: offset and bin are valid but wrong
};

// Of a point and its tangent in the camera frame.
ImagePoint image_point(vec3 p, vec3 q, vec2 focal, vec2 centre, vec2 anchor,
                       float nearest_m, uint bins) {
  const bool is_near = p.z < nearest_m;
  p.z = max(p.z, nearest_m);
  return ImagePoint(rounded_offset(focal * p.xy / p.z + centre - anchor),
                    bin_of(focal * (p.z * q.xy - p.xy * q.z), bins), is_near);
}
