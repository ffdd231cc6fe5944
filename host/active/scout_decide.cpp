// Chooses a scout's next view (Algorithm 2, lines 4 to 10 and 13).
#include "host/active/scout.h"

namespace edgescout {

std::optional<ScoutDecision> Scout::propose() {
  if (proposal_ || has_ended_) return proposal_;
  if (const ScoutEnd end = end_before_decision(); end != ScoutEnd::No) {
    state_.end = end;
    return {};
  }
  was_cancelled_ = false;
  ScoutDecision decision = decide();
  state_.end = decision.view < 0          ? ScoutEnd::NoViewLeft
               : expects_little(decision) ? ScoutEnd::LittleToLearn
                                          : ScoutEnd::No;
  has_ended_ = state_.end != ScoutEnd::No;
  state_.overrule();  // of a run that was resumed
  if (has_ended_)
    state_.last_decision = std::move(decision);
  else
    proposal_ = std::move(decision);
  return proposal_;
}

ScoutDecision Scout::decision_without_expectations(int view) const {
  ScoutDecision decision;
  decision.view = view;
  decision.strategy = options_.next_view.strategy;
  decision.use_paper_formula =
      decision.strategy == Strategy::Information && options_.next_view.use_paper_formula;
  return decision;
}

// The decision's view is negative where no view is left.
ScoutDecision Scout::decide() const {
  // Fixed and Random need no candidates: they continue by their own rule where the first view
  // failed.
  const Strategy strategy = options_.next_view.strategy;
  const bool needs_candidates =
      strategy == Strategy::Information || strategy == Strategy::Disocclusion;
  if (state_.steps.empty() && (state_.failed.empty() || needs_candidates))
    return decision_without_expectations(first_open_view());
  ScoutDecision decision = decision_without_expectations(-1);
  Stopwatch watch(decision.stages, backend_);
  decision.candidates = state_.candidates;
  BitMatrix combinations;
  if (strategy == Strategy::Information && !state_.candidates.empty()) {
    combinations = draw_combinations(decision);
    record_stage(watch, "combinations");
  }
  const std::vector<char> closed = state_.closed();
  const std::vector<ObjectView> views = views_of(views_);
  const TimeLimit limit = until_cancelled();
  decision.views = view_information(
      {{models_, views, backend_, &limit},
       tables_,
       undistorted(camera_),
       state_.views,
       closed,
       state_.candidates,
       &combinations,
       state_.particles,
       workspace_of(options_.pipeline.detect.scan.world, state_.views, undistorted(camera_))},
      options_.next_view);
  decision.view = best_view(decision.views).value_or(-1);
  record_stage(watch, "information");
  return decision;
}

// Also sets the decision's likeliest and unlikeliest.
BitMatrix Scout::draw_combinations(ScoutDecision& decision) const {
  CombinationOptions options = options_.combinations;
  options.seed += state_.steps.size();
  BitMatrix combinations =
      candidate_combinations(models_, state_.candidates, options_.probable_combinations,
                             options_.particles.penetration_m, options, backend_.threads());
  std::vector<double> probabilities;
  for (const Detection& candidate : state_.candidates)
    probabilities.push_back(candidate.probability);
  const CombinationExtremes extremes = extreme_combinations(combinations, probabilities);
  decision.likeliest = extremes.likeliest;
  decision.unlikeliest = extremes.unlikeliest;
  return combinations;
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
