// The cells and beliefs, and log l_ij without its shift.
layout(push_constant) uniform Push { InformationPush push; };
layout(binding = 0) readonly buffer Sums { uint sums[]; };
layout(binding = 1) readonly buffer Counts { uint counts[]; };
layout(binding = 2) readonly buffer Beliefs { float beliefs[]; };

float weight_of(uint i) { return beliefs[i * INFORMATION_BELIEF_WORDS]; }

float log_likelihood(uint i, uint j) {
  const uint at = i * INFORMATION_BELIEF_WORDS, cell = i * push.combinations + j;
  const uint seen = counts[cell] & 0xffffu, unseen = counts[cell] >> 16;
  const float mu = seen == 0u ? push.cap_px : float(sums[cell]) / float(CHAMFER_STEPS_PER_PX * seen);
  return log(max(0.5, beliefs[at + 1u] + float(unseen))) - mu * mu * push.inverse_scale - beliefs[at + 2u];
}
