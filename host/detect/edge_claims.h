// Chooses poses so that every edge of the image is explained by one pose only.
//
// Poses that explain the same edges compete for them. The most probable pose is chosen first and
// claims the image edges that it explains.
#pragma once

#include <span>
#include <vector>

#include "host/core/options.h"
#include "host/register/pose_features.h"

namespace edgescout {

struct EdgeClaimOptions {
  float match_px = 3;  // from a projected point to the edge it explains
  float max_turn_rad = 0.35f;
  // Fraction of the edge length a pose explains; a pose of which better ones claim more is dropped.
  double max_claimed = 0.5;
  void validate() const;  // InputError naming the field and the violated bound
};

void describe(EdgeClaimOptions& options, OptionVisitor& visit);

// A pose that was chosen.
struct EdgeClaim {
  std::size_t index = 0;  // into the poses
  double unclaimed = 1;   // fraction of its explained edge length no better pose had claimed
};

// Chooses greedily by PoseClassifier::probability times the unclaimed fraction, highest first.
// Never chooses a pose whose psi does not exceed chance. Lengths are summed over all views; views
// without an edge index do not take part. The poses must have features.
std::vector<EdgeClaim> claim_edges(const Scene& scene, std::span<const PoseEstimate> poses,
                                   const EdgeClaimOptions& options = {});

// Fraction of the edge length which `pose` explains that the claimants claim; 0 where it explains
// none.
double claimed_fraction(const Scene& scene, const ObjectPose& pose,
                        std::span<const ObjectPose> claimants,
                        const EdgeClaimOptions& options = {});

}  // namespace edgescout
