// When a scout has seen enough (Algorithm 2's termination criteria).
#include <algorithm>

#include "host/active/scout.h"

namespace edgescout {

ScoutEnd Scout::end_before_planning() const {
  const std::vector<char> closed = state_.closed();
  if (static_cast<int>(state_.steps.size()) >= options_.max_views) return ScoutEnd::ViewBudget;
  if (std::ranges::find(closed, 0) == closed.end()) return ScoutEnd::NoViewLeft;
  if (certain()) return ScoutEnd::Certain;
  if (little_learned()) return ScoutEnd::LittleLearned;
  if (options_.max_seconds > 0 && state_.seconds() >= options_.max_seconds)
    return ScoutEnd::TimeLimit;
  return ScoutEnd::No;
}

// An image that shows what none had shown may be followed by others.
bool Scout::certain() const {
  if (state_.detections.empty() || state_.entropy_nats >= options_.min_entropy_nats) return false;
  return !options_.detect_in_every_image || state_.steps.back().new_candidates == 0;
}

// Particles that died and were drawn anew have gained nothing, and have everything to learn.
bool Scout::little_learned() const {
  if (state_.steps.empty() || may_find_more()) return false;
  const ScoutStep& last = state_.steps.back();
  return last.new_candidates == 0 && !last.update.reseeded &&
         last.update.gained_nats < options_.min_gained_nats;
}

// Without candidates there is nothing that information could be about, and everything to find.
bool Scout::may_find_more() const { return state_.candidates.empty(); }

// About the candidates, from whichever view: what is unknown promises something as long as views
// are left.
bool Scout::little_to_learn(const ScoutDecision& decision) const {
  if (options_.next_view.strategy != Strategy::Information || options_.min_information_nats <= 0 ||
      may_find_more())
    return false;
  return std::ranges::all_of(decision.views, [&](const ViewInformation& view) {
    return !view.open || view.information - view.motion_cost < options_.min_information_nats;
  });
}

}  // namespace edgescout
