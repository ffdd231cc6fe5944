// How much of the image a pose explains, and which poses remain when every edge of the image may be explained only once.
//
// Mean scores (Eqs. 7 and 10) prefer small, simple views: two parallel lines match anywhere. What counts is how much is explained: each visible edge
// point stands for the length of its piece of edge in the image, and contributes its direction agreement in excess of chance:
//   evidence = sum over visible points of (|cos(I_theta - xi)| - chance) * length_px
// Of poses that compete for the same edges the one with most evidence is taken first; the image edges it explains are spent.
#pragma once

#include <span>
#include <vector>

#include "host/register/pose_features.h"

namespace edgescout {

struct EvidenceOptions {
  double chance = 0.65;       // mean |cos| of unrelated directions is 2 / pi = 0.64
  float match_px = 3;         // from a projected point to the edge it explains
  float max_turn_rad = 0.35f;
  double max_spent = 0.5;     // of the length a pose explains: more spent by better poses, and it goes
};

// Evidence by the means alone, px: (psi - chance) * length.
double evidence_px(const PoseFeatures& features, const EvidenceOptions& options = {});

struct ChosenPose {
  std::size_t index = 0;    // into the candidates
  double fresh = 1;         // fraction of its explained edge length no better pose had claimed
};

// Greedy choice among candidates (poses with their features), most evidence first; all views count together. Views without an edge index do not take part.
std::vector<ChosenPose> explain_image(std::span<const EdgeModel> models, std::span<const Hypothesis> poses, std::span<const PoseFeatures> features,
                                      std::span<const RegisterView> views, Backend& backend, const EvidenceOptions& options = {});

}  // namespace edgescout
