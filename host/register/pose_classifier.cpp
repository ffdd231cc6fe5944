#include "host/register/pose_classifier.h"

#include <algorithm>
#include <cmath>
#include <iterator>

#include "host/register/pose_classifier_weights.h"
#include "host/register/pose_features.h"
#include "host/register/shading.h"
#include "host/register/thresholds.h"
#include "kernels/error.h"

namespace edgescout {

namespace {

namespace weights = pose_classifier_weights;

constexpr double NOISE_GREY = 2;  // of an image, standard deviation
// Of a pose in one of several views. Something unknown may hide it there.
constexpr double MIN_LOG_PROBABILITY = -10;

// Log ratios of views add up. Fractions are weighted by the points.
void add(EdgeSupport& sum, const EdgeSupport& other, double points) {
  sum.log_ratio += other.log_ratio;
  sum.interior_log_ratio += other.interior_log_ratio;
  sum.support += float(points) * other.support;
  sum.best_displaced += float(points) * other.best_displaced;
}

double logistic(double log_odds) { return 1 / (1 + std::exp(-log_odds)); }

// Evidence grows more slowly than the number of edge points: their errors depend on each other.
double signed_root(double value) { return std::copysign(std::sqrt(std::abs(value)), value); }

// Whether the view has an image that shows the pose.
bool has_image(const PoseFeatures& features) {
  return features.support.log_ratio != 0 || features.shading.pixels > 0;
}

// Log-odds from the share of the measured surface that agrees. Fewer samples say less; hidden and
// missing ones say nothing.
double depth_log_odds(const DepthEvidence& depth) {
  const double measured = depth.agreeing + depth.contradicting;
  if (!(measured > 0)) return 0;
  const weights::Depth& w = weights::DEPTH;
  return std::min(1.0, measured / thresholds::MIN_DEPTH_SAMPLES) *
         (w.bias + w.agreeing * depth.agreeing / measured);
}

void add(DepthEvidence& sum, const DepthEvidence& other) {
  sum.agreeing += other.agreeing;
  sum.contradicting += other.contradicting;
  sum.hidden += other.hidden;
  sum.missing += other.missing;
  sum.offset_m += other.offset_m;
}

double weighted(const PoseFeatures& features, const weights::OneView& w) {
  const EdgeSupport& support = features.support;
  constexpr double min_psi_z_score = 0.5;  // all poses below are equally bad
  return w.bias + w.log_psi_z_score * std::log(std::max(psi_z_score(features), min_psi_z_score)) +
         w.mean_px * features.mean_px + w.root_log_ratio * signed_root(support.log_ratio) +
         w.root_interior_log_ratio * signed_root(support.interior_log_ratio) +
         w.unexplained_grey * unexplained_grey(features.shading) +
         w.best_displaced * support.best_displaced + depth_log_odds(features.depth);
}

// Of the measured surface, what nothing nearer hides. Hidden edges count neither for nor against a
// pose: below the floor a few chance edges would make it probable. 1 without depth.
double unhidden_share(const DepthEvidence& depth) {
  constexpr double few = 2;
  const double seen = few + depth.agreeing + depth.contradicting;
  return seen / (seen + depth.hidden);
}

double log_logistic(double log_odds) {
  return log_odds > 0 ? -std::log1p(std::exp(-log_odds))
                      : log_odds - std::log1p(std::exp(log_odds));
}

double weighted(std::span<const PoseFeatures> informative_views, const weights::SeveralViews& w) {
  double sum = 0;
  for (const PoseFeatures& f : informative_views)
    sum += std::max(log_logistic(PoseClassifier::log_odds(f)) + std::log(unhidden_share(f.depth)),
                    MIN_LOG_PROBABILITY);
  return w.bias + w.log_probability * sum / double(informative_views.size());
}

// What the views of a pose say of it together.
struct OverViews {
  double rank = 0, probability = 0;
  std::size_t informative_views = 0;
};

OverViews classify_over_views(std::span<const PoseFeatures> by_view) {
  std::vector<PoseFeatures> views;
  std::ranges::copy_if(by_view, std::back_inserter(views), is_informative);
  if (views.size() > 1) {
    const double log_odds = weighted(views, weights::SEVERAL_VIEWS);
    return {log_odds, logistic(log_odds), views.size()};
  }
  const double p = views.empty() ? 0 : PoseClassifier::probability(views[0]);
  const double rank =
      by_view.size() == 1 ? PoseClassifier::rank(by_view[0]) : std::log(p / (1 - p));
  return {rank, p, views.size()};
}

// `pooled` are the features of all views.
bool has_psi_above_chance(const PoseFeatures& pooled, std::span<const PoseFeatures> by_view) {
  constexpr double clear_z_score = 2;  // standard errors
  return psi_z_score(pooled) > 0 ||
         std::ranges::count_if(by_view, [](const PoseFeatures& features) {
           return psi_z_score(features) > clear_z_score;
         }) > 1;
}

}  // namespace

double psi_z_score(const PoseFeatures& features) {
  constexpr double spread = 0.308;      // standard deviation of |cos| of unrelated directions
  constexpr double independent_px = 5;  // neighbouring edge points agree or disagree together
  return (features.psi - CHANCE_PSI) / spread * std::sqrt(features.length_px / independent_px);
}

void add(Shading& sum, const Shading& other) {
  sum.pixels += other.pixels;
  sum.squares += other.squares;
  sum.unexplained += other.unexplained;
}

double unexplained_grey(const Shading& shading) {
  const double noise = shading.pixels * NOISE_GREY * NOISE_GREY;
  return shading.pixels > 0 ? std::sqrt((shading.unexplained + noise) / (shading.squares + noise))
                            : 1;
}

bool is_informative(const PoseFeatures& features) {
  constexpr double min_in_image = 0.2;
  return features.points >= thresholds::MIN_POINTS && features.in_image >= min_in_image;
}

PoseFeatures pool_over_views(std::span<const PoseFeatures> by_view) {
  check(!by_view.empty(), "pool_over_views: features of at least one view");
  PoseFeatures sum;
  for (const PoseFeatures& f : by_view) {
    sum.psi += f.psi * f.points;
    sum.mean_px += f.mean_px * f.points;
    sum.matched += f.matched * f.points;
    sum.points += f.points;
    sum.length_px += f.length_px;
    sum.visible += f.visible;
    add(sum.shading, f.shading);
    add(sum.support, f.support, f.points);
    add(sum.depth, f.depth);
  }
  if (sum.points > 0) {
    sum.psi /= sum.points, sum.mean_px /= sum.points, sum.matched /= sum.points;
    sum.support.support /= float(sum.points), sum.support.best_displaced /= float(sum.points);
  } else {
    sum.mean_px = by_view[0].mean_px;
  }
  if (sum.visible > 0) sum.in_image = sum.points / sum.visible;
  return sum;
}

bool has_psi_above_chance(std::span<const PoseFeatures> by_view) {
  return has_psi_above_chance(pool_over_views(by_view), by_view);
}

double PoseClassifier::rank(const PoseFeatures& features) {
  return has_image(features) ? weighted(features, weights::RANK_ONE_VIEW) : -features.mean_px;
}

double PoseClassifier::log_odds(const PoseFeatures& features) {
  return has_image(features) ? weighted(features, weights::PROBABILITY_ONE_VIEW)
                             : -features.mean_px;
}

double PoseClassifier::rank(std::span<const PoseFeatures> by_view) {
  return classify_over_views(by_view).rank;
}

double PoseClassifier::probability(const PoseFeatures& features) {
  if (features.points < thresholds::MIN_POINTS) return 0;
  return features.in_image * logistic(log_odds(features));
}

double PoseClassifier::probability(std::span<const PoseFeatures> by_view) {
  return classify_over_views(by_view).probability;
}

void classify(PoseEstimate& estimate) {
  estimate.classification = {};
  const std::vector<PoseFeatures>& by_view = estimate.features;
  if (by_view.empty()) return;
  const PoseFeatures pooled = pool_over_views(by_view);
  const OverViews over_views = classify_over_views(by_view);
  estimate.classification = {.pooled = pooled,
                             .rank = over_views.rank,
                             .pooled_rank = PoseClassifier::rank(pooled),
                             .pooled_log_odds = PoseClassifier::log_odds(pooled),
                             .probability = over_views.probability,
                             .psi_z_score = psi_z_score(pooled),
                             .unexplained_grey = unexplained_grey(pooled.shading),
                             .informative_views = int(over_views.informative_views),
                             .has_psi_above_chance = has_psi_above_chance(pooled, by_view)};
}

}  // namespace edgescout
