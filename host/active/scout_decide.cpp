// Where a scout looks next.
#include "host/active/scout.h"

namespace edgescout {

// Line 13: where to look next.
std::optional<ScoutDecision> Scout::propose() {
  if (proposal_ || has_ended_) return proposal_;
  if (const ScoutEnd end = end_before_planning(); end != ScoutEnd::No) {
    state_.end = end;
    return {};
  }
  ScoutDecision decision = decide();
  state_.end = decision.view < 0           ? ScoutEnd::NoViewLeft
               : little_to_learn(decision) ? ScoutEnd::LittleToLearn
                                           : ScoutEnd::No;
  has_ended_ = state_.end != ScoutEnd::No;
  state_.overrule();  // of a run that was resumed
  if (has_ended_)
    state_.last_decision = std::move(decision);
  else
    proposal_ = std::move(decision);
  return proposal_;
}

ScoutDecision Scout::without_expectations(int view) const {
  ScoutDecision decision;
  decision.view = view;
  decision.strategy = options_.next_view.strategy;
  decision.use_paper_formula =
      decision.strategy == Strategy::Information && options_.next_view.use_paper_formula;
  return decision;
}

// Lines 4 to 10 and 13. No view is left where the decision's is negative.
ScoutDecision Scout::decide() const {
  // A fixed sequence, and chance, go on where the first view failed.
  const bool needs_belief = options_.next_view.strategy == Strategy::Information ||
                            options_.next_view.strategy == Strategy::Disocclusion;
  if (state_.steps.empty() && (state_.failed.empty() || needs_belief))
    return without_expectations(first_open_view());
  ScoutDecision decision = without_expectations(-1);
  Stopwatch watch(decision.stages);
  decision.candidates = state_.candidates;
  BitMatrix combinations;
  if (options_.next_view.strategy == Strategy::Information && !state_.candidates.empty()) {
    CombinationOptions options = options_.combinations;
    options.seed += state_.steps.size();
    combinations =
        candidate_combinations(models_, state_.candidates, options_.probable_combinations,
                               options_.particles.penetration_m, options, backend_.threads());
    std::vector<double> probabilities;
    for (const Detection& candidate : state_.candidates)
      probabilities.push_back(candidate.probability);
    const CombinationExtremes extremes = extreme_combinations(combinations, probabilities);
    decision.likeliest = extremes.likeliest;
    decision.unlikeliest = extremes.unlikeliest;
    done(watch, "combinations");
  }
  const std::vector<char> closed = state_.closed();
  const std::vector<RegisterView> views = views_of(observations_);
  decision.views = view_information({models_, tables_, undistorted(camera_), state_.views, closed,
                                     views, state_.candidates, &combinations, state_.particles},
                                    backend_, options_.next_view);
  decision.view = best_view(decision.views).value_or(-1);
  done(watch, "information");
  return decision;
}

int Scout::first_open_view() const {
  const std::vector<char> closed = state_.closed();
  const int count = static_cast<int>(closed.size());
  for (int i = 0; i < count; ++i) {
    const int view = (options_.first_view + i) % count;
    if (!closed[static_cast<std::size_t>(view)] &&
        (!options_.next_view.reachable || options_.next_view.reachable(view)))
      return view;
  }
  return -1;
}

}  // namespace edgescout
