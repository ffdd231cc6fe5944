#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_control_flow_attributes : require
#include "shading_sums_push.h"
#include "finite.glsl"

layout(local_size_x = SHADING_GROUP) in;
layout(push_constant) uniform Push { ShadingPush push; };
layout(binding = 0) readonly buffer Depth { float depth[]; };
layout(binding = 1) readonly buffer Maps { ShadingMap maps[]; };
layout(binding = 2) readonly buffer Image { uint image[]; };
layout(binding = 3) readonly buffer Known { float known_m[]; };
layout(binding = 4) writeonly buffer Sums { uint sums[]; };

// One column a sum, one row an invocation; the odd stride keeps both passes free of bank conflicts.
const uint STRIDE = SHADING_GROUP + 1u;
const uint NUMBERS = SHADING_SUM_WORDS - SHADING_FLOATS;
shared float group_floats[SHADING_FLOATS * STRIDE];
shared uint group_numbers[NUMBERS];

const uint SIZE = SHADING_MAP_PX, INNER = SIZE - 2u;

// 0 where nothing is.
float inverse_at(uint at) {
  const float z = depth[at];
  return finite(z) ? 1.0 / z : 0.0;
}

// The normal at pixel `at` of the depth maps; false where the nine pixels around are not one smooth
// surface.
bool normal_at(uint at, vec2 from_centre, ShadingMap map, out vec3 normal) {
  normal = vec3(0.0);
  const float corners = min(min(inverse_at(at - SIZE - 1u), inverse_at(at - SIZE + 1u)),
                            min(inverse_at(at + SIZE - 1u), inverse_at(at + SIZE + 1u)));
  const float left = inverse_at(at - 1u), right = inverse_at(at + 1u);
  const float above = inverse_at(at - SIZE), below = inverse_at(at + SIZE), middle = inverse_at(at);
  const float least = min(min(min(left, right), min(above, below)), min(corners, middle));
  const float bend = max(abs((left - middle) + (right - middle)), abs((above - middle) + (below - middle)));
  if (!(least > 0.0) || bend > push.max_bend * middle) return false;
  const float a = 0.5 * (right - left) * map.fx, b = 0.5 * (below - above) * map.fy;
  normal = normalize(vec3(a, b, middle - a * from_centre.x / map.fx - b * from_centre.y / map.fy));
  return true;
}

bool may_be_hidden(vec2 ray, float z) {
  if (push.known_width == 0u || !(z > 0.0)) return false;
  // Half away from zero; what lies below 1 is not asked.
  const vec2 at = floor(vec2(push.known_fx, push.known_fy) * ray + vec2(push.known_cx, push.known_cy) + 0.5);
  const vec2 last = vec2(push.known_width, push.known_height) - 1.0;
  if (!(at.x >= 1.0 && at.y >= 1.0 && at.x < last.x && at.y < last.y)) return false;
  const float limit = z - push.tolerance_m;
  const uint middle = uint(at.y) * push.known_width + uint(at.x);
  bool is_hidden = false;
  for (int y = -1; y <= 1; ++y)
    for (int x = -1; x <= 1; ++x) {
      const float near_m = known_m[uint(int(middle) + y * int(push.known_width) + x)];
      is_hidden = is_hidden || (finite(near_m) && near_m < limit);
    }
  return is_hidden;
}

// The grey of pixel (i, j) of the map; -1 outside the image.
int grey_at(ShadingMap map, uint i, uint j) {
  const int x = map.x_px + int(map.stride_px * i), y = map.y_px + int(map.stride_px * j);
  if (x < 0 || y < 0 || x >= int(push.width) || y >= int(push.height)) return -1;
  const uint at = uint(y) * push.width + uint(x);
  return int(image[at / 4u] >> (8u * (at % 4u)) & 255u);
}

void main() {
  const uint lane = gl_LocalInvocationID.x, index = gl_WorkGroupID.x + gl_WorkGroupID.y * gl_NumWorkGroups.x;
  const bool has_job = index < push.job_count;
  const uint job = push.first_job + min(index, push.job_count - 1u);
  const ShadingMap map = maps[job];
  float total[SHADING_FLOATS];
  [[unroll]] for (uint s = 0; s < SHADING_FLOATS; ++s) total[s] = 0.0;
  uint pixels = 0u, greys = 0u, squares = 0u;
  [[dont_unroll]] for (uint n = lane; n < INNER * INNER; n += SHADING_GROUP) {
    const uint i = 1u + n % INNER, j = 1u + n / INNER, at = (job * SIZE + j) * SIZE + i;
    const int grey = grey_at(map, i, j);
    if (grey < 0 || !finite(depth[at])) continue;
    const vec2 from_centre = vec2(i, j) - vec2(map.cx, map.cy);
    vec3 normal;
    if (!normal_at(at, from_centre, map, normal) || may_be_hidden(from_centre / vec2(map.fx, map.fy), depth[at]))
      continue;
    const float h[SHADING_HARMONICS] =
        float[SHADING_HARMONICS](1.0, normal.x, normal.y, normal.z, normal.x * normal.y, normal.y * normal.z,
                                 normal.z * normal.x, normal.x * normal.x - normal.y * normal.y,
                                 3.0 * normal.z * normal.z - 1.0);
    // Bounds and places known at compile time: or some drivers leave the loops, and the sums in
    // memory.
    [[unroll]] for (uint a = 0; a < SHADING_HARMONICS; ++a) {
      [[unroll]] for (uint b = 0; b < SHADING_HARMONICS; ++b)
        if (b >= a) total[a * (2u * SHADING_HARMONICS - 1u - a) / 2u + b] += h[a] * h[b];
      total[SHADING_SYSTEM + a] += (float(grey - int(SHADING_MIDDLE_GREY))) * h[a];
    }
    pixels += 1u;
    greys += uint(grey);
    squares += uint(grey * grey);
  }
  if (lane < NUMBERS) group_numbers[lane] = 0u;
  [[unroll]] for (uint s = 0; s < SHADING_FLOATS; ++s) group_floats[s * STRIDE + lane] = total[s];
  barrier();
  atomicAdd(group_numbers[0], pixels);
  atomicAdd(group_numbers[1], greys);
  atomicAdd(group_numbers[2], squares);
  barrier();
  if (!has_job) return;
  if (lane < SHADING_FLOATS) {
    float sum = 0.0;
    [[dont_unroll]] for (uint i = 0; i < SHADING_GROUP; ++i) sum += group_floats[lane * STRIDE + i];
    sums[job * SHADING_SUM_WORDS + lane] = floatBitsToUint(sum);
  } else if (lane < SHADING_SUM_WORDS) {
    sums[job * SHADING_SUM_WORDS + lane] = group_numbers[lane - SHADING_FLOATS];
  }
}
