// When a scout ends (Algorithm 2's termination criteria).
#include <algorithm>

#include "host/active/scout.h"

namespace edgescout {

ScoutEnd Scout::end_before_decision() const {
  const std::vector<char> closed = state_.closed();
  if (static_cast<int>(state_.steps.size()) >= options_.max_views) return ScoutEnd::ViewBudget;
  if (std::ranges::find(closed, 0) == closed.end()) return ScoutEnd::NoViewLeft;
  if (is_certain()) return ScoutEnd::Certain;
  if (gained_little()) return ScoutEnd::LittleLearned;
  if (options_.max_seconds > 0 && state_.seconds() >= options_.max_seconds)
    return ScoutEnd::TimeLimit;
  return ScoutEnd::No;
}

// An image that showed something new may be followed by others that do.
bool Scout::is_certain() const {
  if (state_.detections.empty() || state_.entropy_nats >= options_.min_entropy_nats) return false;
  return !options_.detect_in_every_image || state_.steps.back().new_candidates == 0;
}

// No end without candidates, or where particles were drawn anew: then there is still everything to
// learn.
bool Scout::gained_little() const {
  if (state_.steps.empty() || state_.candidates.empty()) return false;
  const ScoutStep& last = state_.steps.back();
  return last.new_candidates == 0 && !last.update.reseeded &&
         last.update.gained_nats < options_.min_gained_nats;
}

// Information about the candidates, from any view. The exploration bonus does not count: there is
// some as long as views are left. No end without candidates, as above.
bool Scout::expects_little(const ScoutDecision& decision) const {
  if (options_.next_view.strategy != Strategy::Information || options_.min_information_nats <= 0 ||
      state_.candidates.empty())
    return false;
  return std::ranges::all_of(decision.views, [&](const ViewInformation& view) {
    return !view.open || view.information - view.motion_cost < options_.min_information_nats;
  });
}

}  // namespace edgescout
