// The pose of a PoseProblem, and what it brings into sight. Included by the pose_* shaders after
// their buffer of problems.
float word(uint problem, uint i) { return uintBitsToFloat(problems[problem * POSE_PROBLEM_WORDS + i]); }

mat3 rotation_of(uint problem) {
  return mat3(word(problem, 0), word(problem, 4), word(problem, 8), word(problem, 1), word(problem, 5),
              word(problem, 9), word(problem, 2), word(problem, 6), word(problem, 10));
}

vec3 translation_of(uint problem) { return vec3(word(problem, 3), word(problem, 7), word(problem, 11)); }

// Whether the pose is a place at all, by its bits (finite.glsl): every number below 2^60, far
// beyond POSE_MAX_RANGE_M and far below what becomes infinite when it is multiplied.
bool is_somewhere(uint problem) {
  [[dont_unroll]] for (uint i = 0; i < 12u; ++i)
    if ((problems[problem * POSE_PROBLEM_WORDS + i] & 0x7f800000u) >= 0x5d800000u) return false;
  return true;
}

// Whether it is in front of the camera, and nowhere that arithmetic loses it.
bool can_be_seen(vec3 point, PoseCamera camera) {
  const float range = float(POSE_MAX_RANGE_M);
  return point.z > camera.min_depth_m && point.z < range && abs(point.x) < range && abs(point.y) < range;
}
