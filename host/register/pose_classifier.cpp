#include "host/register/pose_classifier.h"

#include <algorithm>
#include <cmath>

#include "host/register/pose_classifier_weights.h"
#include "host/register/pose_features.h"
#include "host/register/shading.h"
#include "host/register/thresholds.h"
#include "kernels/error.h"

namespace edgescout {

namespace {

namespace weights = pose_classifier_weights;

constexpr double NOISE_GREY = 2;  // of an image, standard deviation

double in_standard_errors(double psi_excess, const PoseFeatures& features) {
  constexpr double spread = 0.308;      // standard deviation of |cos| of unrelated directions
  constexpr double independent_px = 5;  // neighbouring edge points agree or disagree together
  return psi_excess / spread * std::sqrt(features.length_px / independent_px);
}

// Log ratios of views add up. Fractions are weighted by the points.
void add(EdgeSupport& sum, const EdgeSupport& other, double points) {
  sum.log_ratio += other.log_ratio;
  sum.interior_log_ratio += other.interior_log_ratio;
  sum.support += float(points) * other.support;
  sum.best_displaced += float(points) * other.best_displaced;
}

double logistic(double log_odds) { return 1 / (1 + std::exp(-log_odds)); }

bool is_informative(const PoseFeatures& f) {
  constexpr double min_in_image = 0.2;
  return f.points >= thresholds::MIN_POINTS && f.in_image >= min_in_image;
}

// Evidence grows more slowly than the number of edge points: their errors depend on each other.
double signed_root(double value) { return std::copysign(std::sqrt(std::abs(value)), value); }

// Whether the view has an image that shows the pose.
bool has_image(const PoseFeatures& features) {
  return features.support.log_ratio != 0 || features.shading.pixels > 0;
}

double weighted(const PoseFeatures& features, const weights::OneView& w) {
  const EdgeSupport& support = features.support;
  constexpr double min_psi_z_score = 0.5;  // all poses below are equally bad
  return w.bias + w.log_psi_z_score * std::log(std::max(psi_z_score(features), min_psi_z_score)) +
         w.mean_px * features.mean_px + w.root_log_ratio * signed_root(support.log_ratio) +
         w.root_interior_log_ratio * signed_root(support.interior_log_ratio) +
         w.unexplained_grey * unexplained_grey(features.shading) +
         w.best_displaced * support.best_displaced;
}

double weighted(const ViewSums& sums) {
  constexpr weights::SeveralViews w = weights::SEVERAL_VIEWS;
  constexpr int max_views = 5;  // no fit has more
  const double sum = w.views * sums.views + w.log_psi_z_score * sums.log_psi_z_score +
                     w.log_background_psi_z_score * sums.log_background_psi_z_score +
                     w.unexplained_grey * sums.unexplained_grey;
  return w.bias + sum / sums.views * std::sqrt(double(std::min(sums.views, max_views)));
}

}  // namespace

double psi_z_score(const PoseFeatures& features) {
  return in_standard_errors(features.psi - CHANCE_PSI, features);
}

double background_psi_z_score(const PoseFeatures& features) {
  return in_standard_errors(features.psi - features.background_psi, features);
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

PoseFeatures pool_over_views(std::span<const PoseFeatures> by_view) {
  check(!by_view.empty(), "pool_over_views: features of at least one view");
  PoseFeatures sum;
  for (const PoseFeatures& f : by_view) {
    sum.psi += f.psi * f.points;
    sum.background_psi += f.background_psi * f.points;
    sum.mean_px += f.mean_px * f.points;
    sum.matched += f.matched * f.points;
    sum.points += f.points;
    sum.length_px += f.length_px;
    sum.visible += f.visible;
    add(sum.shading, f.shading);
    add(sum.support, f.support, f.points);
  }
  if (sum.points > 0) {
    sum.psi /= sum.points, sum.background_psi /= sum.points, sum.mean_px /= sum.points,
        sum.matched /= sum.points;
    sum.support.support /= float(sum.points), sum.support.best_displaced /= float(sum.points);
  } else {
    sum.mean_px = by_view[0].mean_px;
  }
  if (sum.visible > 0) sum.in_image = sum.points / sum.visible;
  return sum;
}

double PoseClassifier::rank(const PoseFeatures& features) {
  return has_image(features) ? weighted(features, weights::RANK_ONE_VIEW) : -features.mean_px;
}

double PoseClassifier::log_odds(const PoseFeatures& features) {
  return has_image(features) ? weighted(features, weights::PROBABILITY_ONE_VIEW)
                             : -features.mean_px;
}

double PoseClassifier::rank(std::span<const PoseFeatures> by_view) {
  if (by_view.size() == 1) return rank(by_view[0]);
  const ViewSums sums = sum_informative_views(by_view);
  if (sums.views > 1) return weighted(sums);
  const double p = probability(by_view);
  return std::log(p / (1 - p));
}

double PoseClassifier::probability(const PoseFeatures& features) {
  if (features.points < thresholds::MIN_POINTS) return 0;
  return features.in_image * logistic(log_odds(features));
}

double PoseClassifier::probability(std::span<const PoseFeatures> by_view) {
  const ViewSums sums = sum_informative_views(by_view);
  if (sums.views == 0) return 0;
  return sums.views == 1 ? probability(*std::ranges::find_if(by_view, is_informative))
                         : logistic(weighted(sums));
}

ViewSums sum_informative_views(std::span<const PoseFeatures> by_view) {
  // Standard errors. A view with less shows nothing of the object, which may be hidden there.
  constexpr double min_z_score = 2;
  ViewSums sums;
  for (const PoseFeatures& f : by_view) {
    if (!is_informative(f)) continue;
    ++sums.views;
    sums.log_psi_z_score += std::log(std::max(psi_z_score(f), min_z_score));
    sums.log_background_psi_z_score += std::log(std::max(background_psi_z_score(f), min_z_score));
    sums.unexplained_grey += unexplained_grey(f.shading);
  }
  return sums;
}

}  // namespace edgescout
