// How much of the image a pose explains, and which poses remain when every edge of the image may be
// explained only once.
//
// Of poses that compete for the same edges the one of most merit is taken first; the image edges it
// explains are claimed.
#pragma once

#include <span>
#include <vector>

#include "host/register/pose_features.h"

namespace edgescout {

struct EdgeClaimOptions {
  float match_px = 3;  // from a projected point to the edge it explains
  float max_turn_rad = 0.35f;
  double max_claimed =
      0.5;  // of the length a pose explains: more claimed by better poses, and it goes
  void validate() const;  // throws InputError naming the field and the violated bound
};

struct EdgeClaim {
  std::size_t index = 0;  // into the candidates
  double unclaimed = 1;   // fraction of its explained edge length no better pose had claimed
};

// Greedy choice among candidates (poses with their features, those of one pose's views side by
// side): the most probable (merit, probability_over_views.h) times unclaimed first, those without
// evidence never; all views count together. Views without an edge index do not take part.
std::vector<EdgeClaim> claim_edges(std::span<const EdgeModel> models,
                                   std::span<const ObjectPose> poses,
                                   std::span<const std::vector<PoseFeatures>> features,
                                   std::span<const RegisterView> views, Backend& backend,
                                   const EdgeClaimOptions& options = {});

}  // namespace edgescout
